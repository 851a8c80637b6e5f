//! The primitives of a body: shapes one by one, and points by the thousand that share one shape.

use std::borrow::Cow;

use super::{Convex, PrimitiveKind};
use crate::error::{Error, Result};
use crate::pose::Vec3;

/// A primitive: its shape and the positions of its vertices. The points of a cloud share one shape, a point at the origin,
/// possibly with a radius; they differ in their only vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Primitive<'a> {
    /// The shape; its own vertices are ignored in favour of `vertices`.
    pub shape: &'a Convex,
    /// The vertices, in the body's frame.
    pub vertices: &'a [Vec3],
}

impl<'a> From<&'a Convex> for Primitive<'a> {
    fn from(shape: &'a Convex) -> Self {
        Self {
            shape,
            vertices: &shape.vertices,
        }
    }
}

impl<'a> Primitive<'a> {
    /// Points whose hull contains the set: the vertices, unless it is curved.
    pub fn bounding_points(self) -> impl Iterator<Item = Vec3> + use<'a> {
        // Nonzero only for a point of a cloud, whose shape is at the origin.
        let offset = self.vertices[0] - self.shape.vertices[0];
        self.shape.bounding_points().iter().map(move |p| p + offset)
    }
}

impl Primitive<'_> {
    /// The point of the set that is farthest along a direction.
    pub fn farthest(&self, direction: &Vec3) -> Vec3 {
        self.shape.farthest_of(self.vertices, direction)
    }

    /// The lowest and highest coordinates of the set.
    pub fn extent(&self) -> (Vec3, Vec3) {
        self.shape.extent_of(self.vertices)
    }

    /// The primitive as a shape of its own, moved by `offset`.
    pub fn moved(&self, offset: &Vec3) -> Convex {
        let mut shape = self.shape.clone();
        shape.vertices.copy_from_slice(self.vertices);
        shape.recentered(&-offset)
    }
}

/// Primitives by index, with their tags. A point is stored as its coordinates only: its tag is its index among the points added
/// with it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Primitives {
    /// In the order of their first primitives; the first run begins at 0.
    runs: Vec<Run>,
    shapes: Vec<Convex>,
    /// The tags of the shapes.
    tags: Vec<u64>,
    points: Vec<Vec3>,
    /// The shapes of points, at the origin: a point, possibly with a radius.
    point_shapes: Vec<Convex>,
    len: usize,
    of_shapes: ShapeTotals,
}

/// What is asked about all shapes of a body, so that they need not be visited for it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct ShapeTotals {
    vertices: usize,
    /// The largest deviation.
    deviation: f64,
    has_functions: bool,
    /// Of points of clouds, too.
    has_curves: bool,
}

/// Consecutive primitives of one sort: shapes, or points of one shape.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Run {
    first: u32,
    /// The index of its first shape or point in `shapes` or `points`.
    place: u32,
    /// The index in `point_shapes` of its points' shape; `None` for a run of shapes.
    point_shape: Option<u32>,
}

/// Primitives as they were added: one shape, or points of one shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PrimitiveGroup<'a> {
    /// One shape and its tag.
    Shape(&'a Convex, u64),
    /// Points of one shape, which is at the origin; their tags are their indices in the slice.
    Points(&'a Convex, &'a [Vec3]),
}

impl Primitives {
    /// The number of primitives.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there is no primitive.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Whether all primitives are points, possibly with radii.
    pub fn are_points(&self) -> bool {
        self.shapes.is_empty() && !self.is_empty()
    }

    /// The centres of all points, in order. If all primitives are points, the indices are those of the primitives.
    pub fn points(&self) -> &[Vec3] {
        &self.points
    }

    /// The largest radius of a point.
    pub fn largest_point_radius(&self) -> f64 {
        let radii = self.point_shapes.iter().map(Convex::radius);
        radii.fold(0.0, f64::max)
    }

    /// Whether all points have the same radius.
    pub fn have_one_radius(&self) -> bool {
        self.point_shapes.len() < 2
    }

    /// Adds a shape with its tag.
    pub fn push(&mut self, shape: Convex, tag: u64) {
        if self.runs.last().is_none_or(|run| run.point_shape.is_some()) {
            self.begin(self.shapes.len(), None);
        }
        let all = &mut self.of_shapes;
        all.vertices += shape.vertices.len();
        all.deviation = all.deviation.max(shape.deviation);
        if shape.curve.is_some() {
            all.has_curves = true;
            all.has_functions |= shape.kind() == PrimitiveKind::SupportFunction;
        }
        self.shapes.push(shape);
        self.tags.push(tag);
        self.len += 1;
    }

    /// Adds points, tagged by their indices among these. `shape` is what each is, at the origin.
    pub fn push_points(&mut self, shape: &Convex, points: impl ExactSizeIterator<Item = Vec3>) {
        let count = points.len();
        if count == 0 {
            return;
        }
        // Points are often added in batches of one radius.
        if self.point_shapes.last() != Some(shape) {
            self.point_shapes.push(shape.clone());
            self.of_shapes.has_curves |= shape.curve.is_some();
        }
        self.begin(self.points.len(), Some(self.point_shapes.len() as u32 - 1));
        self.points.extend(points);
        self.len += count;
    }

    /// Reserves memory for more points, or fails if there is too little.
    pub fn reserve_points(&mut self, count: usize) -> Result<()> {
        self.points.try_reserve(count).map_err(Error::memory)
    }

    /// Reserves memory for as many more primitives as others hold.
    pub(super) fn reserve(&mut self, others: &Self) {
        self.runs.reserve(others.runs.len());
        self.shapes.reserve(others.shapes.len());
        self.tags.reserve(others.tags.len());
        self.points.reserve(others.points.len());
    }

    /// Gives back spare capacity.
    pub fn shrink(&mut self) {
        self.runs.shrink_to_fit();
        self.shapes.shrink_to_fit();
        self.tags.shrink_to_fit();
        self.points.shrink_to_fit();
        self.point_shapes.shrink_to_fit();
    }

    fn begin(&mut self, place: usize, point_shape: Option<u32>) {
        self.runs.push(Run {
            first: self.len as u32,
            place: place as u32,
            point_shape,
        });
    }

    /// The run of a primitive, and its index within the run. Panics where there is no such primitive, as slices do.
    #[inline(always)]
    fn locate(&self, index: usize) -> (&Run, usize) {
        if index >= self.len {
            no_such(index, self.len);
        }
        let run = match &self.runs[..] {
            [only] => only,
            runs => &runs[runs.partition_point(|run| run.first as usize <= index) - 1],
        };
        (run, index - run.first as usize)
    }

    /// The primitive of this index. Panics where there is none; see [`Primitives::try_get`].
    #[inline(always)]
    pub fn get(&self, index: usize) -> Primitive<'_> {
        let (run, offset) = self.locate(index);
        let place = run.place as usize + offset;
        match run.point_shape {
            None => Primitive::from(&self.shapes[place]),
            Some(shape) => Primitive {
                shape: &self.point_shapes[shape as usize],
                vertices: &self.points[place..=place],
            },
        }
    }

    /// The primitive of this index; `None` where there is none.
    pub fn try_get(&self, index: usize) -> Option<Primitive<'_>> {
        (index < self.len).then(|| self.get(index))
    }

    /// The only primitive, if there is exactly one.
    pub fn only(&self) -> Option<Primitive<'_>> {
        (self.len == 1).then(|| self.get(0))
    }

    /// The tag of a primitive. Panics where there is no such primitive.
    #[inline(always)]
    pub fn tag(&self, index: usize) -> u64 {
        let (run, offset) = self.locate(index);
        match run.point_shape {
            None => self.tags[run.place as usize + offset],
            Some(_) => offset as u64,
        }
    }

    /// All primitives in the order of their indices.
    pub fn iter(&self) -> impl Iterator<Item = Primitive<'_>> {
        (0..self.len).map(move |i| self.get(i))
    }

    /// The shapes that are not points of clouds, with their primitive indices and tags.
    pub fn shapes(&self) -> impl Iterator<Item = (u32, &Convex, u64)> {
        let runs = self
            .runs
            .iter()
            .enumerate()
            .filter(|(_, run)| run.point_shape.is_none());
        runs.flat_map(move |(k, run)| {
            let held = run.place as usize..run.place as usize + self.run_length(k);
            let of_run = self.shapes[held.clone()].iter().zip(&self.tags[held]);
            (run.first..)
                .zip(of_run)
                .map(|(index, (shape, &tag))| (index, shape, tag))
        })
    }

    fn run_length(&self, run: usize) -> usize {
        let end = self
            .runs
            .get(run + 1)
            .map_or(self.len, |next| next.first as usize);
        end - self.runs[run].first as usize
    }

    /// All primitives in order; points that were added together form one group.
    pub fn groups(&self) -> impl Iterator<Item = PrimitiveGroup<'_>> {
        (0..self.runs.len()).flat_map(move |k| {
            let run = self.runs[k];
            let held = run.place as usize..run.place as usize + self.run_length(k);
            let (shapes, points) = match run.point_shape {
                None => (held, None),
                Some(shape) => {
                    let shape = &self.point_shapes[shape as usize];
                    (
                        0..0,
                        Some(PrimitiveGroup::Points(shape, &self.points[held])),
                    )
                }
            };
            let shapes = shapes.map(move |i| PrimitiveGroup::Shape(&self.shapes[i], self.tags[i]));
            shapes.chain(points)
        })
    }

    /// All primitives as shapes in one slice; points are copied out of their clouds.
    pub fn as_shapes(&self) -> Cow<'_, [Convex]> {
        if self.points.is_empty() {
            return Cow::Borrowed(&self.shapes);
        }
        let own = |primitive: Primitive| primitive.moved(&Vec3::zeros());
        Cow::Owned(self.iter().map(own).collect())
    }

    /// The same primitives moved by `-center`, without spare capacity.
    pub fn recentered(&self, center: &Vec3) -> Self {
        let moved = |shape: &Convex| shape.clone().recentered(center);
        Self {
            runs: self.runs.as_slice().into(),
            shapes: self.shapes.iter().map(moved).collect(),
            tags: self.tags.as_slice().into(),
            points: self.points.iter().map(|point| point - center).collect(),
            point_shapes: self.point_shapes.as_slice().into(),
            len: self.len,
            of_shapes: self.of_shapes,
        }
    }

    /// The lowest and highest coordinates of all.
    pub fn extent(&self) -> (Vec3, Vec3) {
        self.iter()
            .map(|primitive| primitive.extent())
            .reduce(|all, one| (all.0.inf(&one.0), all.1.sup(&one.1)))
            .unwrap_or_default()
    }

    /// The largest distance of a bounding point from the origin.
    pub fn radius(&self) -> f64 {
        let of_shape = |shape: &Convex| {
            let squares = shape.bounding_points().iter().map(Vec3::norm_squared);
            squares.fold(0.0, f64::max).sqrt()
        };
        self.groups()
            .map(|group| match group {
                PrimitiveGroup::Shape(shape, _) => of_shape(shape),
                PrimitiveGroup::Points(shape, points) => {
                    let corners = shape.bounding_points();
                    let norms = points.iter().map(|p| farthest_corner(p, corners).norm());
                    norms.fold(0.0, f64::max)
                }
            })
            .fold(0.0, f64::max)
    }

    /// The number of vertices of all primitives.
    pub fn vertex_count(&self) -> usize {
        self.points.len() + self.of_shapes.vertices
    }

    /// The largest deviation of a primitive.
    pub fn deviation(&self) -> f64 {
        self.of_shapes.deviation
    }

    /// Whether a primitive is given by a support function of the caller's.
    pub fn have_functions(&self) -> bool {
        self.of_shapes.has_functions
    }

    /// Whether each primitive is the hull of its vertices: none is curved.
    pub fn are_hulls(&self) -> bool {
        !self.of_shapes.has_curves
    }

    /// Bytes of memory that the points take.
    pub fn point_bytes(&self) -> usize {
        size_of_val(&self.points[..])
    }
}

#[cold]
#[inline(never)]
fn no_such(index: usize, len: usize) -> ! {
    panic!("primitive {index} of {len} primitives")
}

/// The largest absolute coordinates of a box around a point, given its corners relative to the point.
fn farthest_corner(point: &Vec3, corners: &[Vec3]) -> Vec3 {
    let along = |axis: usize| {
        let places = corners
            .iter()
            .map(|corner| (point[axis] + corner[axis]).abs());
        places.fold(0.0, f64::max)
    };
    Vec3::new(along(0), along(1), along(2))
}
