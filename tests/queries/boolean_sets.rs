//! Unions, intersections, complements and differences of sets of all kinds, against classes and distances computed set by
//! set by brute force.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::cobject::{
    CObject, Class, InducedOptions, LeftOut, Predicate, PureOptions, PureShape, SObjects,
};
use cstk::environment::{Change, Environment};
use cstk::error::Result;
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::Vec3;
use cstk::query::{Configuration, Distance, DistanceKind, Explanation, QueryContext};
use cstk::robot::{Coordinate, JointKind};
use cstk::space::{Space, WorldBox};

use helpers::oracle::hull_distance;
use helpers::random::Random;
use helpers::robots::{link, robot};
use helpers::shapes::box_corners;

/// A configuration of a cube that only shifts: lengths in C-space are lengths in the world.
type Place = Vec3;

/// What the test knows of a leaf: its signed distance, as far as it is known inside.
enum Truth {
    /// Obstacles by their corners, and the margin.
    Corners(Vec<Vec<Vec3>>, f64),
    /// The set where some coordinate is beyond the range.
    Limits(f64),
    Box(Vec3, Vec3),
    HalfSpace(Vec3, f64),
    Ball(Vec3, f64),
    /// Within an infinite cylinder about z.
    Pole(f64),
}

struct Known {
    cobject: Arc<CObject>,
    truth: Truth,
    epsilon: f64,
}

impl Known {
    /// The distance from the set, and whether q is in it.
    fn distance(&self, q: &Place) -> (f64, bool) {
        let signed = match &self.truth {
            Truth::Corners(obstacles, margin) => {
                let own: Vec<Vec3> = link_corners().iter().map(|c| c + q).collect();
                let gaps = obstacles.iter().map(|o| hull_distance(&own, o).upper);
                (gaps.fold(f64::INFINITY, f64::min) - margin).max(0.0)
            }
            Truth::Limits(half) => {
                let clear = half - q.amax();
                return (clear.max(0.0), clear < 0.0);
            }
            Truth::Box(low, high) => {
                let beyond = (low - q).sup(&(q - high));
                let outside = beyond.sup(&Vec3::zeros()).norm();
                if outside > 0.0 { outside } else { beyond.max() }
            }
            Truth::HalfSpace(normal, offset) => (normal.dot(q) - offset) / normal.norm(),
            Truth::Ball(center, radius) => (q - center).norm() - radius,
            Truth::Pole(radius) => q.xy().norm() - radius,
        };
        (signed.max(0.0), signed <= 0.0)
    }

    fn class(&self, q: &Place) -> Class {
        let (distance, inside) = self.distance(q);
        if inside {
            Class::Inside
        } else if distance <= self.epsilon {
            Class::Contact
        } else {
            Class::Outside
        }
    }

    /// Whether rounding decides.
    fn is_tight(&self, q: &Place) -> bool {
        let (distance, inside) = self.distance(q);
        !inside && (distance < 1e-9 || (distance - self.epsilon).abs() < 1e-9)
    }
}

fn link_corners() -> Vec<Vec3> {
    box_corners([0.3, 0.2, 0.4])
}

fn body(points: &[Vec3]) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_polyhedron(points, 0).unwrap();
    let body = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    Arc::new(body.unwrap())
}

const LIMIT: f64 = 1.8;

fn shifting_cube() -> Arc<Space> {
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    let mut links: Vec<_> = (0..3usize)
        .map(|i| link(i.checked_sub(1), JointKind::Prismatic, axes[i]))
        .collect();
    links[2].body = Some(body(&link_corners()));
    let range = Some(Coordinate::Interval {
        lower: -LIMIT,
        upper: LIMIT,
    });
    let space = Space::new(vec![robot(3, links)], &[range; 3], WorldBox::unbounded());
    Arc::new(space.unwrap())
}

struct Pole(f64);

impl Predicate for Pole {
    fn classify(&self, q: &[f64]) -> Result<Class> {
        let inside = q[0].hypot(q[1]) <= self.0;
        Ok(if inside {
            Class::Inside
        } else {
            Class::Outside
        })
    }
    fn distance(&self, q: &[f64]) -> Result<Option<f64>> {
        Ok(Some(q[0].hypot(q[1]) - self.0))
    }
    fn is_exact(&self) -> bool {
        true
    }
    fn knows_depth(&self) -> bool {
        true
    }
    fn gradient(&self, q: &[f64], row: &mut [f64]) -> Result<bool> {
        let length = q[0].hypot(q[1]);
        row.copy_from_slice(&[q[0] / length, q[1] / length, 0.0]);
        Ok(true)
    }
}

/// Leaves of every kind over one space.
fn leaves(random: &mut Random, space: &Arc<Space>) -> Vec<Known> {
    let mut all = Vec::new();
    for (margin, epsilon) in [(0.0, 0.0), (0.1, 0.2), (0.0, 0.3)] {
        let environment = Arc::new(Environment::default());
        let mut obstacles = Vec::new();
        for _ in 0..3 {
            let corners = box_corners([0.5, 0.3, 0.4]);
            let pose = random.pose(1.5);
            obstacles.push(corners.iter().map(|c| pose.transform_point(c)).collect());
            let body = body(&corners);
            environment.apply(&[Change::add(body, pose)]).unwrap();
        }
        let options = InducedOptions {
            contact_epsilon: epsilon,
            margin,
        };
        let all_objects = SObjects::All(environment);
        let made = CObject::induced(space.clone(), &[], all_objects, LeftOut::default(), options);
        all.push(Known {
            cobject: Arc::new(made.unwrap()),
            truth: Truth::Corners(obstacles, margin),
            epsilon,
        });
    }
    let mut add = |shape: PureShape, truth: Truth, epsilon: f64| {
        let options = PureOptions {
            contact_epsilon: epsilon,
            scale: Some(1.0),
        };
        all.push(Known {
            cobject: Arc::new(CObject::pure(space.clone(), shape, options).unwrap()),
            truth,
            epsilon,
        });
    };
    add(PureShape::BeyondLimits, Truth::Limits(LIMIT), 0.25);
    for epsilon in [0.1, 0.4] {
        let (a, b) = (random.point(1.5), random.point(1.5));
        let (low, high) = (a.inf(&b), a.sup(&b));
        let shape = PureShape::Box {
            low: low.as_slice().to_vec(),
            high: high.as_slice().to_vec(),
        };
        add(shape, Truth::Box(low, high), epsilon);
        let (normal, offset) = (random.point(2.0), random.within(-0.5, 0.5));
        let shape = PureShape::HalfSpace {
            normal: normal.as_slice().to_vec(),
            offset,
            is_open: false,
        };
        add(shape, Truth::HalfSpace(normal, offset), epsilon);
        let (center, radius) = (random.point(1.0), random.within(0.3, 1.0));
        let shape = PureShape::Ball {
            center: center.as_slice().to_vec(),
            radius,
        };
        add(shape, Truth::Ball(center, radius), epsilon);
    }
    add(
        PureShape::Predicate(Arc::new(Pole(0.7))),
        Truth::Pole(0.7),
        0.0,
    );
    all
}

enum Tree {
    Leaf(usize),
    Union(Vec<Tree>),
    Intersection(Vec<Tree>),
    Complement(Box<Tree>),
    Difference(Box<[Tree; 2]>),
}

impl Tree {
    fn random(random: &mut Random, depth: usize, leaves: usize) -> Self {
        let next = |random: &mut Random| Self::random(random, depth - 1, leaves);
        if depth == 0 || random.below(5) == 0 {
            return Self::Leaf(random.below(leaves));
        }
        match random.below(4) {
            0 => Self::Union((0..2 + random.below(2)).map(|_| next(random)).collect()),
            1 => Self::Intersection((0..2 + random.below(2)).map(|_| next(random)).collect()),
            2 => Self::Complement(Box::new(next(random))),
            _ => Self::Difference(Box::new([next(random), next(random)])),
        }
    }

    fn build(&self, leaves: &[Known]) -> Arc<CObject> {
        let all = |parts: &[Tree]| -> Vec<_> { parts.iter().map(|p| p.build(leaves)).collect() };
        let made = match self {
            Self::Leaf(i) => return leaves[*i].cobject.clone(),
            Self::Union(parts) => CObject::union(&all(parts)),
            Self::Intersection(parts) => CObject::intersection(&all(parts)),
            Self::Complement(part) => CObject::complement(&part.build(leaves)),
            Self::Difference(parts) => {
                CObject::difference(&parts[0].build(leaves), &parts[1].build(leaves))
            }
        };
        Arc::new(made.unwrap())
    }

    fn class(&self, of_leaves: &[Class]) -> Class {
        let class = |part: &Tree| part.class(of_leaves);
        match self {
            Self::Leaf(i) => of_leaves[*i],
            Self::Union(parts) => parts.iter().map(class).max().unwrap(),
            Self::Intersection(parts) => parts.iter().map(class).min().unwrap(),
            Self::Complement(part) => opposite(class(part)),
            Self::Difference(parts) => class(&parts[0]).min(opposite(class(&parts[1]))),
        }
    }

    /// Whether a configuration is in the set, where `in_leaves` tells of each leaf.
    fn holds(&self, in_leaves: &[bool]) -> bool {
        match self {
            Self::Leaf(i) => in_leaves[*i],
            Self::Union(parts) => parts.iter().any(|part| part.holds(in_leaves)),
            Self::Intersection(parts) => parts.iter().all(|part| part.holds(in_leaves)),
            Self::Complement(part) => !part.holds(in_leaves),
            Self::Difference(parts) => parts[0].holds(in_leaves) && !parts[1].holds(in_leaves),
        }
    }

    /// The leaves that decide, and whether their complements are meant.
    fn decisive(&self, of_leaves: &[Class], complemented: bool, found: &mut Vec<(usize, bool)>) {
        let class = self.class(of_leaves);
        let mut among = |parts: &[Tree]| {
            for part in parts.iter().filter(|part| part.class(of_leaves) == class) {
                part.decisive(of_leaves, complemented, found);
            }
        };
        match self {
            Self::Leaf(i) => found.push((*i, complemented)),
            Self::Union(parts) | Self::Intersection(parts) => among(parts),
            Self::Complement(part) => part.decisive(of_leaves, !complemented, found),
            Self::Difference(parts) => {
                among(&parts[..1]);
                if opposite(parts[1].class(of_leaves)) == class {
                    parts[1].decisive(of_leaves, !complemented, found);
                }
            }
        }
    }

    /// Of a union of leaves, which.
    fn as_union(&self) -> Option<Vec<usize>> {
        match self {
            Self::Leaf(i) => Some(vec![*i]),
            Self::Union(parts) => {
                let parts: Option<Vec<_>> = parts.iter().map(Self::as_union).collect();
                Some(parts?.concat())
            }
            _ => None,
        }
    }
}

fn opposite(class: Class) -> Class {
    match class {
        Class::Inside => Class::Outside,
        Class::Contact => Class::Contact,
        Class::Outside => Class::Inside,
    }
}

/// 10,000 trees of depth up to 6, at configurations all over: classes as computed set by set, distances that no member of the
/// set is nearer than, and of unions exactly the least.
#[test]
fn random_trees_are_what_their_leaves_say() {
    let mut random = Random::new(77);
    let mut query = QueryContext::new();
    let space = shifting_cube();
    let mut seen = [0usize; 3];
    let mut bounds_above_zero = 0;
    for _ in 0..40 {
        let leaves = leaves(&mut random, &space);
        let others: Vec<(Place, Vec<bool>)> = (0..60)
            .map(|_| {
                let q = random.point(2.2);
                let inside = leaves.iter().map(|leaf| leaf.distance(&q).1).collect();
                (q, inside)
            })
            .collect();
        for _ in 0..10 {
            let place = random.point(2.2);
            assert!(!leaves.iter().any(|leaf| leaf.is_tight(&place)));
            let classes: Vec<Class> = leaves.iter().map(|leaf| leaf.class(&place)).collect();
            let q = Configuration::Coordinates(place.as_slice());
            for _ in 0..25 {
                let tree = Tree::random(&mut random, 6, leaves.len());
                let cobject = tree.build(&leaves);
                let class = query.classify(&cobject, q).unwrap();
                assert_eq!(class, tree.class(&classes));
                seen[class as usize] += 1;
                let explanation = query.explain(&cobject, q, 20).unwrap();
                assert_eq!(explanation.class, class);
                check_reasons(&explanation, &leaves, &classes, &tree);
                let found = query.distance(&cobject, q, f64::INFINITY).unwrap();
                check_distance(&found, class, &place, &tree, &others);
                if let Some(union) = tree.as_union() {
                    let distances = union.iter().map(|&i| leaves[i].distance(&place).0);
                    let least = distances.fold(f64::INFINITY, f64::min);
                    assert_eq!(found.kind, DistanceKind::Exact);
                    assert!((found.distance - least).abs() < 1e-12);
                }
                bounds_above_zero +=
                    usize::from(found.kind == DistanceKind::LowerBound && found.lower > 0.0);
                let threshold = random.within(0.0, 0.5);
                let within = query.within(&cobject, q, threshold).unwrap();
                assert_eq!(within, found.lower <= threshold, "{found:?} {threshold}");
            }
        }
    }
    println!("outside, contact, inside: {seen:?}; lower bounds above 0: {bounds_above_zero}");
    assert!(seen.iter().sum::<usize>() == 10_000 && seen.iter().all(|&count| count > 300));
    assert!(bounds_above_zero > 500);
}

fn check_distance(
    found: &Distance,
    class: Class,
    place: &Place,
    tree: &Tree,
    others: &[(Place, Vec<bool>)],
) {
    assert!(found.lower <= found.upper && found.lower >= 0.0);
    if class == Class::Inside {
        assert_eq!(found.lower, 0.0, "{found:?}");
    }
    let mut least = f64::INFINITY;
    for (other, inside) in others {
        if tree.holds(inside) {
            least = least.min((other - place).norm());
        }
    }
    assert!(
        found.lower <= least + 1e-12,
        "{found:?}: a member is {least} away"
    );
    if found.kind == DistanceKind::Empty {
        assert_eq!(least, f64::INFINITY);
    }
}

/// The decisive leaves are those on whose way down every part has the class of what holds it, and their pairs are listed.
fn check_reasons(explanation: &Explanation, leaves: &[Known], classes: &[Class], tree: &Tree) {
    let of = |serial: u64| {
        let mut all = leaves.iter();
        all.position(|leaf| leaf.cobject.serial() == serial)
            .unwrap()
    };
    let mut said = Vec::new();
    for verdict in &explanation.leaves {
        let i = of(verdict.leaf.serial);
        assert_eq!(verdict.class, classes[i]);
        said.extend(verdict.decisive.then_some((i, verdict.complemented)));
        let reasons = &explanation.list.witnesses[verdict.first_witness..][..verdict.witness_count];
        assert!(reasons.iter().all(|w| w.leaf == verdict.leaf));
        let has_reason = verdict.class != Class::Outside;
        let expected = verdict.decisive && has_reason && !explanation.list.truncated;
        assert!(!expected || !reasons.is_empty(), "{verdict:?}");
        for witness in reasons {
            let limit = if verdict.class == Class::Inside {
                0.0
            } else {
                leaves[i].epsilon
            };
            assert!(witness.distance <= limit);
        }
    }
    let mut expected = Vec::new();
    tree.decisive(classes, false, &mut expected);
    for list in [&mut said, &mut expected] {
        list.sort_unstable();
        list.dedup();
    }
    assert_eq!(said, expected);
}

/// Every pair of classes under every operation.
#[test]
fn truth_tables() {
    let space = shifting_cube();
    let mut query = QueryContext::new();
    let ball = |radius: f64| {
        let shape = PureShape::Ball {
            center: vec![0.0; 3],
            radius,
        };
        let options = PureOptions {
            contact_epsilon: 0.1,
            scale: Some(1.0),
        };
        Arc::new(CObject::pure(space.clone(), shape, options).unwrap())
    };
    let q = Configuration::Coordinates(&[1.0, 0.0, 0.0]);
    use Class::{Contact, Inside, Outside};
    let by_class = [
        (Outside, ball(0.5)),
        (Contact, ball(0.95)),
        (Inside, ball(1.5)),
    ];
    let table = [
        // a, b: union, intersection, a without b
        (Outside, Outside, Outside, Outside, Outside),
        (Outside, Contact, Contact, Outside, Outside),
        (Outside, Inside, Inside, Outside, Outside),
        (Contact, Outside, Contact, Outside, Contact),
        (Contact, Contact, Contact, Contact, Contact),
        (Contact, Inside, Inside, Contact, Outside),
        (Inside, Outside, Inside, Outside, Inside),
        (Inside, Contact, Inside, Contact, Contact),
        (Inside, Inside, Inside, Inside, Outside),
    ];
    for (a, b, union, intersection, difference) in table {
        let of = |class: Class| {
            by_class
                .iter()
                .find(|(c, _)| *c == class)
                .unwrap()
                .1
                .clone()
        };
        let parts = [of(a), of(b)];
        let mut class = |made: Result<CObject>| query.classify(&made.unwrap(), q).unwrap();
        assert_eq!(class(CObject::union(&parts)), union);
        assert_eq!(class(CObject::intersection(&parts)), intersection);
        assert_eq!(class(CObject::difference(&parts[0], &parts[1])), difference);
        assert_eq!(class(CObject::complement(&parts[0])), opposite(a));
    }
}
