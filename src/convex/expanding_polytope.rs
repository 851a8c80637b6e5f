//! The facets of a Minkowski difference that are nearest to the origin, by a polytope that expands within it (van den Bergen 2001), with a
//! proof that no other facet is nearer.
//!
//! The difference s - r of two convex sets that meet holds the origin. Triangles between points of it make a closed surface around a
//! fixed point m of its inside. Each has a unit normal n and an offset d: its corners are on or beyond the plane n . x = d, and m is
//! before it. A ray from m to a point x outside the difference leaves the surface through a triangle, at y, and goes on to x, so that
//! n . x >= n . y >= d. The least offset is therefore a lower bound of the depth. The triangle that has it gives way to the point of
//! the difference that is farthest along its normal, together with all triangles before that point, until none is farther than
//! rounding: then the triangle lies on the boundary.
//!
//! That every ray leaves through a triangle is not a matter of rounding. What gives way and what takes its place have the same rim, and
//! hold nothing between them but tetrahedra of a triangle and the new point, with a plane between these corners and m. So triangles may
//! have any form. Where rounding leaves no such plane, or no step forward, the search gives up.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::facet_lines::unit_across;
use super::placed::PlacedPrimitive;
use crate::gjk::Support;
use crate::pose::Vec3;
use crate::tolerance::SUPPORT_ERROR;
use crate::work_meter::WorkMeter;

/// A triangle on the boundary of the difference, within rounding.
#[derive(Clone, Copy, Debug)]
pub struct NearFacet {
    pub normal: Vec3,
    /// The product of the normal with the farthest point of the difference.
    pub height: f64,
    /// The vertices of r and of s whose differences its corners are.
    pub corners: [[u32; 2]; 3],
}

/// The two sets whose difference it is.
type Sets<'a> = [&'a PlacedPrimitive<'a>; 2];

/// Polytopes of more corners are given up, times the vertices of both sets: nearly all of the boundary is as near.
const MAX_CORNERS: usize = 4;

/// A first tetrahedron whose points are nearer to the plane of the others than this, times the rounding, counts as flat.
const FLAT: f64 = 1e4;

/// How far two polytopes overlap.
#[derive(Clone, Copy, Debug)]
pub enum Overlap {
    /// By at least this.
    Deep(f64),
    /// As far as this facet of their difference tells.
    Hardly(NearFacet),
}

struct Corner {
    point: Vec3,
    of: [u32; 2],
}

struct Facet {
    /// Counterclockwise, seen from outside. The side number i goes from the corner number i to the next.
    corners: [u32; 3],
    /// What each side borders on.
    beside: [Side; 3],
    normal: Vec3,
    offset: f64,
    /// It has given way to others.
    is_gone: bool,
}

/// A side of a triangle.
#[derive(Clone, Copy)]
struct Side {
    facet: u32,
    number: usize,
}

/// A triangle in the queue; the greatest is the one with the least offset.
struct Queued {
    offset: f64,
    facet: u32,
}

impl PartialEq for Queued {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Queued {}

impl PartialOrd for Queued {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Queued {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_offset = other.offset.total_cmp(&self.offset);
        by_offset.then(other.facet.cmp(&self.facet))
    }
}

/// The polytope, and memory of a search, reused from pair to pair.
#[derive(Default)]
pub struct ExpandingPolytope {
    /// A point of the difference and the product of a direction with it are rounded by no more.
    rounding: f64,
    /// Inside for good.
    middle: Vec3,
    corners: Vec<Corner>,
    facets: Vec<Facet>,
    queue: BinaryHeap<Queued>,
    /// What bordered on the triangles that gave way last, in its order around them.
    rim: Vec<Side>,
    /// Sides to look at, the last one first.
    open: Vec<Side>,
    /// The triangles on the boundary, each with the height of the difference along its normal.
    reached: Vec<(u32, f64)>,
    found: Vec<NearFacet>,
}

/// The corner or side after the given one.
fn next(i: usize) -> usize {
    (i + 1) % 3
}

/// The point of the difference that is farthest along a direction.
fn extreme([r, s]: Sets, direction: &Vec3) -> Corner {
    let [of_r, of_s] = [r.extreme(&-direction), s.extreme(direction)];
    Corner {
        point: of_s.point - of_r.point,
        of: [of_r.name, of_s.name],
    }
}

impl ExpandingPolytope {
    /// The facets of the difference of two polytopes whose offset exceeds the least by no more than `within`. `None` for flat differences
    /// and where the search gives up. Each corner of the polytope is charged to the meter; what is found is incomplete if its limit is
    /// exceeded.
    pub fn nearest_facets(
        &mut self,
        sets: Sets,
        size: f64,
        within: f64,
        meter: &mut WorkMeter,
    ) -> Option<&[NearFacet]> {
        self.begin(sets, size)?;
        self.expand(sets, within, f64::INFINITY, meter)?;
        Some(&self.found)
    }

    /// How far two polytopes overlap: as far as is proved once it is more than `enough`, else along the nearest facet. `None` as for
    /// [`Self::nearest_facets`].
    pub fn overlap(&mut self, sets: Sets, size: f64, enough: f64) -> Option<Overlap> {
        self.begin(sets, size)?;
        let enough = enough + self.rounding;
        let offset = self.expand(sets, 0.0, enough, &mut WorkMeter::default())?;
        if offset > enough {
            return Some(Overlap::Deep(offset - self.rounding));
        }
        let by_height = |one: &&NearFacet, other: &&NearFacet| one.height.total_cmp(&other.height);
        self.found
            .iter()
            .min_by(by_height)
            .copied()
            .map(Overlap::Hardly)
    }

    /// Begins with a tetrahedron; `None` if the difference is flat.
    fn begin(&mut self, sets: Sets, size: f64) -> Option<()> {
        self.rounding = SUPPORT_ERROR * size;
        self.corners.clear();
        self.facets.clear();
        self.queue.clear();
        self.find_tetrahedron(sets)?;
        let points = self.corners.iter().map(|corner| corner.point);
        self.middle = points.sum::<Vec3>() / 4.0;
        let tetrahedron = [
            ([0, 2, 1], [(3, 0), (2, 0), (1, 0)]),
            ([0, 1, 3], [(0, 2), (2, 2), (3, 1)]),
            ([1, 2, 3], [(0, 1), (3, 2), (1, 1)]),
            ([2, 0, 3], [(0, 0), (1, 2), (2, 1)]),
        ];
        for (corners, beside) in tetrahedron {
            let side = |(facet, number)| Side { facet, number };
            self.add(corners, beside.map(side))?;
        }
        Some(())
    }

    /// Four corners that span a tetrahedron, the last of them on the side where the first three go round counterclockwise: the first
    /// in the direction in which the origin probably is nearest to the boundary.
    fn find_tetrahedron(&mut self, sets: Sets) -> Option<()> {
        let [r, s] = sets;
        let outwards = r.middle() - s.middle();
        let first = outwards.try_normalize(0.0).unwrap_or_else(Vec3::x);
        let ends = [first, -first].map(|direction| extreme(sets, &direction));
        let along = (ends[1].point - ends[0].point).try_normalize(FLAT * self.rounding)?;
        let from = ends[0].point;
        let axis = Vec3::ith(along.iamin(), 1.0);
        let across = (axis - along * along.dot(&axis)).normalize();
        let aside = |corner: &Corner| {
            let arm = corner.point - from;
            arm - along * along.dot(&arm)
        };
        let others = [across, -across].map(|direction| extreme(sets, &direction));
        let [one, other] = others;
        let third = if aside(&one).norm() >= aside(&other).norm() {
            one
        } else {
            other
        };
        let upright = along.cross(&aside(&third).try_normalize(FLAT * self.rounding)?);
        let [above, below] = [upright, -upright].map(|direction| extreme(sets, &direction));
        let height = |corner: &Corner| upright.dot(&(corner.point - from));
        let [up, down] = [height(&above), -height(&below)];
        if up.max(down) <= FLAT * self.rounding {
            return None;
        }
        let [start, end] = ends;
        self.corners.extend(match up >= down {
            true => [start, end, third, above],
            false => [start, third, end, below],
        });
        Some(())
    }

    /// Adds a triangle; `None` if no plane is told that surely leaves the middle on the inner side.
    fn add(&mut self, corners: [u32; 3], beside: [Side; 3]) -> Option<()> {
        let [a, b, c] = corners.map(|corner| self.corners[corner as usize].point);
        let offset = |normal: &Vec3| {
            let heights = [a, b, c].map(|point| normal.dot(&point));
            heights.into_iter().fold(f64::INFINITY, f64::min)
        };
        let is_outward = |normal: &Vec3| {
            let room = 4.0 * self.rounding;
            normal.dot(&self.middle) < offset(normal) - room
        };
        let across = unit_across(&(b - a), &(c - a));
        // Three corners on a line lie in the plane of what is beside it.
        let normal = across.filter(is_outward).or_else(|| {
            let neighbour = self.facets.get(beside[0].facet as usize)?;
            Some(neighbour.normal).filter(is_outward)
        })?;
        let offset = offset(&normal);
        let facet = self.facets.len() as u32;
        self.queue.push(Queued { offset, facet });
        self.facets.push(Facet {
            corners,
            beside,
            normal,
            offset,
            is_gone: false,
        });
        Some(())
    }

    /// Expands until the nearest facets are found, or no offset is `enough` or less. The least offset then; `None` where the search
    /// gives up.
    fn expand(
        &mut self,
        sets: Sets,
        within: f64,
        enough: f64,
        meter: &mut WorkMeter,
    ) -> Option<f64> {
        let max_corners = MAX_CORNERS
            * sets
                .map(PlacedPrimitive::vertex_count)
                .iter()
                .sum::<usize>();
        self.reached.clear();
        let (mut least_offset, mut least) = (f64::INFINITY, f64::INFINITY);
        while let Some(Queued { offset, facet }) = self.queue.pop() {
            if offset > least + within + self.rounding {
                break;
            }
            let Facet {
                is_gone, normal, ..
            } = self.facets[facet as usize];
            if is_gone {
                continue;
            }
            if self.reached.is_empty() {
                least_offset = offset;
            }
            if offset > enough {
                break;
            }
            meter.charge(1);
            if meter.is_exceeded() {
                break;
            }
            let corner = extreme(sets, &normal);
            let height = normal.dot(&corner.point);
            least = least.min(height);
            if height <= offset + self.rounding {
                self.reached.push((facet, height));
                continue;
            }
            // A corner that the triangle has already takes it no farther.
            let is_own = |&own: &u32| self.corners[own as usize].of == corner.of;
            let is_stuck = self.facets[facet as usize].corners.iter().any(is_own);
            if is_stuck || self.corners.len() >= max_corners {
                return None;
            }
            self.take_in(facet, corner)?;
        }
        self.found.clear();
        for &(facet, height) in &self.reached {
            let Facet {
                is_gone,
                normal,
                corners,
                ..
            } = self.facets[facet as usize];
            if !is_gone {
                self.found.push(NearFacet {
                    normal,
                    height,
                    corners: corners.map(|corner| self.corners[corner as usize].of),
                });
            }
        }
        Some(least_offset)
    }

    /// Puts a new corner in the place of a triangle and of all that are before it. `None` where their rim does not go once round.
    fn take_in(&mut self, facet: u32, corner: Corner) -> Option<()> {
        self.give_way(facet, &corner.point);
        let apex = self.corners.len() as u32;
        self.corners.push(corner);
        let first = self.facets.len() as u32;
        let count = self.rim.len();
        for i in 0..count {
            let side = self.rim[i];
            let [before, behind] = [(i + count - 1) % count, (i + 1) % count];
            // What is outside the rim goes along it the other way.
            let [to, from] = self.ends(side);
            if self.ends(self.rim[behind])[1] != to {
                return None;
            }
            let spoke = |k: usize, number: usize| Side {
                facet: first + k as u32,
                number,
            };
            self.add([from, to, apex], [side, spoke(behind, 2), spoke(before, 1)])?;
            self.facets[side.facet as usize].beside[side.number] = spoke(i, 0);
        }
        (count >= 3).then_some(())
    }

    /// The corners where a side begins and ends.
    fn ends(&self, Side { facet, number }: Side) -> [u32; 2] {
        let corners = &self.facets[facet as usize].corners;
        [corners[number], corners[next(number)]]
    }

    /// Takes a triangle away, with all that are before a point and hang together with it, and leaves their rim.
    fn give_way(&mut self, facet: u32, point: &Vec3) {
        let gone = &mut self.facets[facet as usize];
        gone.is_gone = true;
        self.rim.clear();
        self.open.extend(gone.beside.into_iter().rev());
        while let Some(side) = self.open.pop() {
            let facet = &mut self.facets[side.facet as usize];
            if facet.is_gone {
                continue;
            }
            if facet.normal.dot(point) > facet.offset {
                facet.is_gone = true;
                let following = next(side.number);
                self.open.push(facet.beside[next(following)]);
                self.open.push(facet.beside[following]);
            } else {
                self.rim.push(side);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use cstk_scenes::Random;

    use super::*;
    use crate::convex::PlacedBuffer;
    use crate::pose::{Mat3, Pose, rotation_about};
    use crate::primitive::{Convex, Form, block, convex_polyhedron};

    fn vector(random: &mut Random) -> Vec3 {
        Vec3::from(random.point(1.0))
    }

    fn hull(random: &mut Random, count: usize) -> Convex {
        let stretch = Vec3::from_fn(|_, _| 10f64.powf(random.within(-1.0, 0.0)));
        let points = (0..count).map(|_| vector(random).component_mul(&stretch));
        convex_polyhedron(&points.collect::<Vec<_>>()).unwrap()
    }

    /// All that a facet's normal can be: the normals of faces and the cross products of edges, either way.
    fn all_normals(sets: [&PlacedPrimitive; 2]) -> Vec<Vec3> {
        let faces = sets.map(|set| (0..set.shape.faces.len()).map(|face| set.normal(face)));
        let along = |set: &PlacedPrimitive| -> Vec<Vec3> {
            let ends = set.shape.edges.iter().map(|&edge| set.edge_ends(edge));
            ends.map(|(from, to)| to - from).collect()
        };
        let [r, s] = sets.map(along);
        let crosses = r.iter().flat_map(|r| s.iter().map(|s| r.cross(s)));
        let lines = faces.into_iter().flatten().chain(crosses);
        let normals = lines.filter_map(|line| line.try_normalize(1e-9));
        normals.flat_map(|normal| [normal, -normal]).collect()
    }

    /// How the search ended on a pair of sets, checked against all normals.
    fn is_found([r, s]: [&Convex; 2], pose: &Pose, within: f64) -> bool {
        let forms = [r, s].map(Form::of);
        let mut buffer = PlacedBuffer::default();
        let r = PlacedPrimitive::at_home(r, forms[0].as_ref());
        let s = buffer.place(s, forms[1].as_ref(), pose);
        let corners = r.vertices().iter().chain(s.vertices());
        let size = corners.map(|corner| corner.amax()).fold(0.0, f64::max);
        let meter = &mut WorkMeter::default();
        let mut polytope = ExpandingPolytope::default();
        let Some(found) = polytope.nearest_facets([&r, &s], size, within, meter) else {
            return false;
        };
        let found = found.to_vec();
        let height = |normal: &Vec3| s.high_along(normal) - r.low_along(normal);
        let normals = all_normals([&r, &s]);
        let heights: Vec<f64> = normals.iter().map(height).collect();
        let want = heights.iter().copied().fold(f64::INFINITY, f64::min);
        // Sets that are apart have no depth.
        if want < 0.0 {
            return true;
        }
        let least = found.iter().map(|facet| facet.height);
        let least = least.fold(f64::INFINITY, f64::min);
        assert!((least - want).abs() <= 1e-14 * size, "{least} for {want}");
        // No corner may be off a facet's plane, and no near facet may be missing.
        for facet in &found {
            assert!(facet.height <= least + within + 1e-14 * size);
            assert!((height(&facet.normal) - facet.height).abs() <= 1e-14 * size);
            for [of_r, of_s] in facet.corners {
                let corner = s.vertex(of_s) - r.vertex(of_r);
                assert!((facet.normal.dot(&corner) - facet.height).abs() <= 1e-14 * size);
            }
        }
        for (part, is_deep) in [(0.5, true), (2.0, false)] {
            match polytope.overlap([&r, &s], size, part * want) {
                Some(Overlap::Deep(depth)) => {
                    assert!(is_deep && depth > part * want && depth <= want)
                }
                Some(Overlap::Hardly(facet)) => {
                    assert!(!is_deep || want < 1e-13 * size);
                    assert!((facet.height - want).abs() <= 1e-14 * size);
                }
                None => panic!("given up"),
            }
        }
        for (normal, height) in normals.iter().zip(heights) {
            let is_near = height <= least + 0.99 * within;
            let is_it = |facet: &NearFacet| (facet.normal - normal).norm() < 1e-5;
            // A supporting line that is no facet's normal is longer than that of a facet beside it.
            let is_beside = |facet: &NearFacet| facet.height < height - 1e-13 * size;
            let is_told = found.iter().any(is_it) || found.iter().any(is_beside);
            assert!(!is_near || is_told, "{normal} at {height} is missing");
        }
        true
    }

    #[test]
    fn the_nearest_facets_are_those_of_all_normals() {
        let mut random = Random::new(91);
        for round in 0..400 {
            let count = [4, 5, 8, 12, 30][round % 5];
            let sets = [hull(&mut random, count), hull(&mut random, 4 + round % 13)];
            let pose = Pose {
                rotation: rotation_about(&vector(&mut random).normalize(), random.within(0.0, 6.0)),
                translation: vector(&mut random) * 0.1,
            };
            let within = [0.0, 1e-3, 0.1][round % 3];
            assert!(is_found([&sets[0], &sets[1]], &pose, within), "{round}");
        }
    }

    #[test]
    fn blocks_whose_sides_are_parallel_have_facets_of_many_corners() {
        let mut random = Random::new(92);
        let quarters = [Vec3::x(), Vec3::y(), Vec3::z()]
            .map(|axis| rotation_about(&axis, std::f64::consts::FRAC_PI_2));
        let mut given_up = 0;
        for round in 0..400 {
            let mut steps = |least: usize| {
                Vec3::from_fn(|_, _| 0.25 * (least + random.within(0.0, 4.0) as usize) as f64)
            };
            let sets = [steps(1), steps(1)].map(|half| block(&Pose::identity(), &half).unwrap());
            let translation = steps(0).map(|x| 0.25 * x);
            let rotation = match round % 3 {
                0 => Mat3::identity(),
                1 => quarters[random.within(0.0, 3.0) as usize],
                _ => rotation_about(&Vec3::z(), random.within(0.0, 6.0)),
            };
            let pose = Pose {
                rotation,
                translation,
            };
            given_up += u32::from(!is_found([&sets[0], &sets[1]], &pose, 0.0));
        }
        assert!(given_up == 0, "{given_up} of 400 given up");
    }

    /// Polygons, segments and points beside solids make solid differences, and none beside each other in a plane.
    #[test]
    fn flat_sets() {
        let mut random = Random::new(93);
        let mut given_up = 0;
        for round in 0..400 {
            let flat = hull(&mut random, 1 + round % 3);
            let solid = hull(&mut random, 10);
            let pose = Pose::from_translation(vector(&mut random) * 0.05);
            given_up += u32::from(!is_found([&flat, &solid], &pose, 1e-3));
            let sets = [&flat, &flat];
            assert!(!is_found(sets, &Pose::identity(), 0.0));
        }
        assert!(given_up == 0, "{given_up} of 400 given up");
    }
}
