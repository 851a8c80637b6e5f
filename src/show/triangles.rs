//! Triangles of pictures: kept, or made anew each time they are needed.

use std::io;

use crate::pose::Vec3;

/// Triangles with a normal at each corner.
#[derive(Default)]
pub struct Triangles {
    pub positions: Vec<Vec3>,
    pub normals: Vec<Vec3>,
}

impl Triangles {
    /// A flat triangle, counter-clockwise around `normal`.
    pub fn push(&mut self, corners: [Vec3; 3], normal: Vec3) {
        self.positions.extend(corners);
        self.normals.extend([normal; 3]);
    }
}

/// Flat triangles that nobody keeps: there may be more of them than memory has room for.
pub trait TriangleStream {
    /// Hands over the corners, counter-clockwise around the normal, and the normal of each; the same ones whenever it is called. Ends
    /// where `visit` fails.
    fn try_each(&self, visit: &mut dyn FnMut([Vec3; 3], Vec3) -> io::Result<()>) -> io::Result<()>;
}

/// How many corners a stream has, and what box they fill, in single precision.
pub struct StreamExtent {
    pub corners: usize,
    pub low: [f32; 3],
    pub high: [f32; 3],
}

impl StreamExtent {
    pub fn of(stream: &dyn TriangleStream) -> Self {
        let mut extent = Self {
            corners: 0,
            low: [f32::INFINITY; 3],
            high: [f32::NEG_INFINITY; 3],
        };
        let gone_through = stream.try_each(&mut |corners, _| {
            for corner in corners {
                extent.corners += 1;
                for i in 0..3 {
                    let x = corner[i] as f32;
                    extent.low[i] = extent.low[i].min(x);
                    extent.high[i] = extent.high[i].max(x);
                }
            }
            Ok(())
        });
        debug_assert!(gone_through.is_ok(), "nothing is written");
        extent
    }
}

/// What [`write_stream`] writes of a corner: its place and its normal, in single precision.
pub const STREAMED_CORNER: usize = 24;

/// Writes place and normal of each corner.
pub fn write_stream(stream: &dyn TriangleStream, file: &mut dyn io::Write) -> io::Result<()> {
    stream.try_each(&mut |corners, normal| {
        for corner in corners {
            for x in corner.iter().chain(&normal) {
                file.write_all(&(*x as f32).to_le_bytes())?;
            }
        }
        Ok(())
    })
}
