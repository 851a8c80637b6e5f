//! Contacts of the hulls of two primitives' vertices: normal, contact mode, and the points that span parallel features (§4.4,
//! Fig. 17).

use nalgebra::Vector2;

use super::closest::Closest;
use super::contact::{Contact, ContactMode, deepest_first, mode_of};
use super::contact_normal::ContactPair;
use super::feature_pair::FeatureTouch;
use super::placed::{PlacedPrimitive, Precision, gap_of_primitives};
use super::segment::{Segment, closest_parameters};
use crate::pose::Vec3;
use crate::primitive::{Feature, FeatureKind, convex_hull_2d, plane_axes};
use crate::tolerance;

/// Corners are level to within the first of these times L that gives a contact: closest points in the middle of features that are hardly
/// parallel have none until these count as parallel. A larger last one lists corners that are visibly farther away than the closest points.
const LEVEL: [f64; 3] = [tolerance::PARALLEL, 1e-9, 1e-7];

/// The contact at the closest points of two hulls that are apart, if their features have a contact mode.
#[inline(always)]
pub fn first_polytope_contact(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    closest: &Closest,
    precision: &Precision,
) -> Option<Contact> {
    let mode = mode_of(closest.features)?;
    if precision.planar && mode == ContactMode::EdgeEdge {
        return None;
    }
    let pair = ContactPair {
        r,
        s,
        closest,
        precision,
    };
    let normal = pair.normal_if_apart()?;
    // Cores that are apart are nearest along this normal, so this is also the deepest contact of the rounded sets around them.
    Some(contact_between(
        closest.points,
        closest.features,
        normal,
        mode,
        precision,
    ))
}

#[inline(always)]
fn contact_between(
    points: [Vec3; 2],
    features: [Feature; 2],
    normal: Vec3,
    mode: ContactMode,
    precision: &Precision,
) -> Contact {
    let gap = normal.dot(&(points[0] - points[1]));
    let error = precision.error;
    Contact {
        points,
        normal,
        distance: if gap > error { gap } else { 0.0 },
        gap: if gap.abs() > error { gap } else { 0.0 },
        mode,
        features,
    }
}

/// The contacts of the hulls of two primitives' vertices.
pub fn polytope_contacts(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    closest: &Closest,
    precision: &Precision,
) -> Vec<Contact> {
    let pair = ContactPair {
        r,
        s,
        closest,
        precision,
    };
    if let Some(touch) = pair.feature_touch() {
        let closest = Closest {
            points: touch.points,
            ..*closest
        };
        let pair = ContactPair {
            closest: &closest,
            ..pair
        };
        return contacts_along(&pair, touch.normal);
    }
    match pair.normal() {
        Some(normal) => contacts_along(&pair, normal),
        None => Vec::new(),
    }
}

/// The first of these, found without the others where none of them can be deeper.
pub fn first_of_polytope_contacts(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    closest: &Closest,
    precision: &Precision,
) -> Option<Contact> {
    let pair = ContactPair {
        r,
        s,
        closest,
        precision,
    };
    let mode = listed_mode(&pair);
    if let Some(mode) = mode
        && let Some(touch) = pair.feature_touch()
    {
        let FeatureTouch { points, normal, .. } = touch;
        return Some(contact_between(
            points,
            closest.features,
            normal,
            mode,
            precision,
        ));
    }
    let normal = pair.normal()?;
    if let Some(mode) = mode {
        let (points, features) = (closest.points, closest.features);
        let first = contact_between(points, features, normal, mode, precision);
        // No contact is deeper than the sets overlap along the normal.
        if gap_of_primitives(r, s, &normal) >= first.gap - 0.5 * precision.error {
            return Some(first);
        }
    }
    contacts_along(&pair, normal).into_iter().next()
}

fn contacts_along(pair: &ContactPair, normal: Vec3) -> Vec<Contact> {
    let ContactPair {
        r,
        s,
        closest,
        precision,
    } = *pair;
    let slack = tolerance::PARALLEL * precision.size;
    let mode = listed_mode(pair);
    // Common case: a single corner is nearest, and there is no other contact.
    if let Some(mode) = mode
        && closest.distance > precision.error
        && (has_lone_extreme(r, &-normal, slack) || has_lone_extreme(s, &normal, slack))
    {
        let (points, features) = (closest.points, closest.features);
        return vec![contact_between(points, features, normal, mode, precision)];
    }
    let mut lists = LEVEL
        .into_iter()
        .map(|level| contacts_within(level * precision.size, pair, normal));
    if let Some(found) = lists.find(|found| !found.is_empty()) {
        return found;
    }
    // Parallel edges of a planar pair may overlap by less than the slack.
    let mode = mode_of(closest.features);
    let only = mode.map(|mode| Contact {
        points: closest.points,
        normal,
        distance: closest.distance,
        gap: closest.distance,
        mode,
        features: closest.features,
    });
    only.into_iter().collect()
}

/// The mode of the contact at the closest points, if they have one that is listed: in the plane edges do not cross.
fn listed_mode(pair: &ContactPair) -> Option<ContactMode> {
    let planar = pair.precision.planar;
    mode_of(pair.closest.features).filter(|mode| !(planar && *mode == ContactMode::EdgeEdge))
}

/// The contacts of features whose corners are level to within `slack`.
fn contacts_within(slack: f64, pair: &ContactPair, normal: Vec3) -> Vec<Contact> {
    let ContactPair {
        r,
        s,
        closest,
        precision,
    } = *pair;
    let sides = [
        SupportFeature::new(r, &-normal, slack),
        SupportFeature::new(s, &normal, slack),
    ];
    let mut list = ContactList {
        normal,
        precision,
        contacts: Vec::new(),
    };
    let has_mode = listed_mode(pair).is_some();
    // Of sets that overlap the closest points are a common one, less deep than the corner or the crossing next to it.
    let gap = normal.dot(&(closest.points[0] - closest.points[1]));
    let is_common = has_mode
        && closest.distance <= precision.error
        && gap_of_primitives(r, s, &normal) < gap - precision.error;
    if has_mode && !is_common {
        list.offer(closest.points, closest.features);
    }
    list.offer_corners(&sides, slack);
    if !precision.planar {
        list.offer_crossings(&sides, slack);
    }
    if is_common {
        list.offer(closest.points, closest.features);
    }
    let mut found = list.contacts;
    deepest_first(&mut found, precision);
    found
}

/// Contacts with one normal, without duplicates.
struct ContactList<'a> {
    normal: Vec3,
    precision: &'a Precision,
    contacts: Vec<Contact>,
}

impl ContactList<'_> {
    /// Adds a contact unless its features have no contact mode or its points are listed.
    fn offer(&mut self, points: [Vec3; 2], features: [Feature; 2]) {
        let same = tolerance::SAME_CONTACT * self.precision.size;
        let is_same = |other: &Contact| {
            (other.points[0] - points[0]).norm() <= same
                && (other.points[1] - points[1]).norm() <= same
        };
        if let Some(mode) = mode_of(features)
            && !self.contacts.iter().any(is_same)
        {
            let contact = contact_between(points, features, self.normal, mode, self.precision);
            self.contacts.push(contact);
        }
    }

    /// Offers the corners of each supporting feature that are over the other.
    fn offer_corners(&mut self, [on_r, on_s]: &[SupportFeature; 2], slack: f64) {
        for (i, corner) in on_r.corners() {
            if on_s.covers(&corner, slack) {
                let foot = on_s.foot(&corner);
                let features = [Feature::vertex(i), on_s.feature_at(&foot, slack)];
                self.offer([corner, foot], features);
            }
        }
        for (j, corner) in on_s.corners() {
            if on_r.covers(&corner, slack) {
                let foot = on_r.foot(&corner);
                let features = [on_r.feature_at(&foot, slack), Feature::vertex(j)];
                self.offer([foot, corner], features);
            }
        }
    }

    /// Offers the crossings of the two features' outlines, seen along the normal.
    fn offer_crossings(&mut self, [on_r, on_s]: &[SupportFeature; 2], slack: f64) {
        let sides_r = on_r.sides();
        if sides_r.is_empty() {
            return;
        }
        let sides_s = on_s.sides();
        for (edge_r, segment_r) in &sides_r {
            // Most sides lie on one side of the other's line.
            let across = self.normal.cross(segment_r.along());
            let beyond = slack * across.norm();
            let [start, _] = segment_r.ends();
            for (edge_s, segment_s) in &sides_s {
                let [from, to] = segment_s.ends().map(|end| across.dot(&(end - start)));
                if from.min(to) > beyond || from.max(to) < -beyond {
                    continue;
                }
                let (t, u) = closest_parameters(segment_r, segment_s);
                let inside = |x: f64| x > 0.0 && x < 1.0;
                let points = [segment_r.at(t), segment_s.at(u)];
                let between = points[0] - points[1];
                let aside = between - self.normal * self.normal.dot(&between);
                if inside(t) && inside(u) && aside.norm() <= slack {
                    self.offer(points, [Feature::edge(*edge_r), Feature::edge(*edge_s)]);
                }
            }
        }
    }
}

/// Whether only one vertex is within `slack` of the farthest along a direction.
fn has_lone_extreme(placed: &PlacedPrimitive, direction: &Vec3, slack: f64) -> bool {
    let farthest = placed.high_along(direction);
    let heights = placed.vertices().iter().map(|v| direction.dot(v));
    heights.filter(|height| *height >= farthest - slack).count() == 1
}

/// The cosine of the angle between the normal of a face of level corners and the direction along which they are level is more than this,
/// unless the slack is a hundredth of the face.
const MIN_LEVEL_COSINE: f64 = 0.9999;

/// The supporting feature of a primitive along a direction, with its corners in order around the direction.
struct SupportFeature<'a> {
    placed: PlacedPrimitive<'a>,
    ring: Vec<u32>,
    /// Of three and more corners, where each is, and the way inwards across the side from it to the next, as long as that side.
    sides: Vec<(Vec3, Vec3)>,
    normal: Vec3,
    feature: Feature,
    /// Whether the ring's corners are all the feature's: those of faces that are level together are not.
    is_whole: bool,
}

impl<'a> SupportFeature<'a> {
    fn new(placed: &PlacedPrimitive<'a>, direction: &Vec3, slack: f64) -> Self {
        let farthest = placed.high_along(direction);
        let level: Vec<u32> = (0..placed.vertex_count() as u32)
            .filter(|&i| direction.dot(&placed.vertex(i)) >= farthest - slack)
            .collect();
        let (ring, feature) = if level.len() == 1 {
            let corner = Feature::vertex(level[0]);
            (level, corner)
        } else if let Some((face, ring)) = whole_face(placed, &level, direction, slack) {
            (ring, face)
        } else {
            let ring = outline(placed, &level, direction, slack);
            let feature = feature_of(placed, &ring);
            (ring, feature)
        };
        let is_whole = feature.kind != FeatureKind::Face || {
            let corners = &placed.shape.faces[feature.index as usize].vertices;
            ring.iter().all(|corner| corners.contains(corner))
        };
        let corner = |i: usize| placed.vertex(ring[i % ring.len()]);
        let sides = match ring.len() {
            1 | 2 => Vec::new(),
            n => (0..n)
                .map(|i| (corner(i), direction.cross(&(corner(i + 1) - corner(i)))))
                .collect(),
        };
        Self {
            placed: *placed,
            sides,
            ring,
            normal: *direction,
            feature,
            is_whole,
        }
    }

    /// The feature that holds a foot.
    fn feature_at(&self, foot: &Vec3, slack: f64) -> Feature {
        if self.is_whole {
            return self.feature;
        }
        let mut faces = 0..self.placed.shape.faces.len();
        let holding = faces.find(|&face| {
            let (height, is_over) = self.placed.over_face(face, foot);
            is_over && height.abs() <= slack
        });
        holding.map_or(self.feature, |face| Feature::face(face as u32))
    }

    fn corners(&self) -> impl Iterator<Item = (u32, Vec3)> + '_ {
        self.ring.iter().map(|&i| (i, self.placed.vertex(i)))
    }

    /// The sides of the ring that are edges of the primitive.
    fn sides(&self) -> Vec<(u32, Segment)> {
        let n = self.ring.len();
        let pairs = if n == 2 { 1 } else { n };
        (0..pairs)
            .filter(|_| n > 1)
            .map(|i| [self.ring[i], self.ring[(i + 1) % n]])
            .filter_map(|ends| {
                edge_between(&self.placed, ends)
                    .map(|e| (e, Segment::new(self.placed.edge_ends(ends))))
            })
            .collect()
    }

    /// Whether the feature, seen along its normal, covers the point to within `slack`. A single corner covers only itself.
    fn covers(&self, point: &Vec3, slack: f64) -> bool {
        let to_foot = point - self.foot(point);
        match self.ring.len() {
            1 | 2 => (to_foot - self.normal * self.normal.dot(&to_foot)).norm() <= slack,
            _ => self
                .sides
                .iter()
                .all(|(corner, inwards)| inwards.dot(&(point - corner)) >= -slack * inwards.norm()),
        }
    }

    /// The point of the feature under (or over) `point`.
    fn foot(&self, point: &Vec3) -> Vec3 {
        match self.ring[..] {
            [i] => self.placed.vertex(i),
            [i, j] => {
                let segment = Segment::new(self.placed.edge_ends([i, j]));
                let here = Segment::new((*point, *point));
                segment.at(closest_parameters(&here, &segment).1)
            }
            _ => {
                let normal = match self.feature.kind {
                    FeatureKind::Face if self.is_whole => {
                        self.placed.normal(self.feature.index as usize)
                    }
                    _ => self.normal,
                };
                // Of a body that is hardly larger than the slack any face may have the most of its level corners.
                let normal = if normal.dot(&self.normal) > MIN_LEVEL_COSINE {
                    normal
                } else {
                    self.normal
                };
                point - normal * normal.dot(&(point - self.placed.vertex(self.ring[0])))
            }
        }
    }
}

/// The vertices of `level` that are corners of their outline seen along a direction, in order around it.
fn outline(placed: &PlacedPrimitive, level: &[u32], direction: &Vec3, slack: f64) -> Vec<u32> {
    let (x, y) = plane_axes(direction);
    let points = level.iter().map(|&i| placed.vertex(i));
    let flat: Vec<_> = points.map(|p| Vector2::new(x.dot(&p), y.dot(&p))).collect();
    let corners = convex_hull_2d(&flat, slack);
    corners.iter().map(|&i| level[i as usize]).collect()
}

/// The face that has these level vertices for its corners, with them in the order of [`outline`]; `None` where it has others, or a corner
/// that is hardly one.
fn whole_face(
    placed: &PlacedPrimitive,
    level: &[u32],
    direction: &Vec3,
    slack: f64,
) -> Option<(Feature, Vec<u32>)> {
    let face = placed.feature_of(level.get(..3)?)?;
    if face.kind != FeatureKind::Face {
        return None;
    }
    let ring = &placed.shape.faces[face.index as usize].vertices;
    if ring.len() != level.len() || !level.iter().all(|i| ring.contains(i)) {
        return None;
    }
    let (x, y) = plane_axes(direction);
    let corner = |i: usize| placed.vertex(ring[i % ring.len()]);
    let mut first = (Vector2::repeat(f64::INFINITY), 0);
    for i in 0..ring.len() {
        let [before, here, next] = [corner(i + ring.len() - 1), corner(i), corner(i + 1)];
        let side = next - before;
        if direction.dot(&(here - before).cross(&side)) <= slack * side.norm() {
            return None;
        }
        let flat = Vector2::new(x.dot(&here), y.dot(&here));
        if (flat.x, flat.y) < (first.0.x, first.0.y) {
            first = (flat, i);
        }
    }
    let mut ring = ring.to_vec();
    ring.rotate_left(first.1);
    Some((face, ring))
}

fn edge_between(placed: &PlacedPrimitive, ends: [u32; 2]) -> Option<u32> {
    placed
        .shape
        .edges
        .iter()
        .position(|&[a, b]| [a, b] == ends || [b, a] == ends)
        .map(|e| e as u32)
}

/// The feature with these corners: for two the edge that joins them, for more the face that holds most of them.
fn feature_of(placed: &PlacedPrimitive, ring: &[u32]) -> Feature {
    match ring {
        [i] => Feature::vertex(*i),
        [i, j] => {
            // Along a straight outline several edges may lie between the two ends; the first of them is taken.
            let edge = edge_between(placed, [*i, *j]).or_else(|| {
                let starts = placed.shape.edges.iter();
                starts.clone().position(|e| e.contains(i)).map(|e| e as u32)
            });
            edge.map_or(Feature::vertex(*i), Feature::edge)
        }
        _ => {
            let shared = |f: usize| {
                ring.iter()
                    .filter(|i| placed.shape.faces[f].vertices.contains(i))
                    .count()
            };
            (0..placed.shape.faces.len())
                .rev()
                .max_by_key(|&f| shared(f))
                .map_or(Feature::interior(), |f| Feature::face(f as u32))
        }
    }
}
