//! Body files: the primitives and the whole hierarchy, so that loading builds nothing. docs/body-file.md describes the
//! format.

use std::path::Path;

use sha2::{Digest, Sha256};

use super::body::{Body, BodyStatistics};
use crate::error::Result;
use crate::hierarchy::BuildTimes;
use crate::pose::check_dimension;
use crate::sealed_file::{FileFormat, Writer};
use crate::whole_file::{read_whole, write_whole};

pub const VERSION: u32 = 7;

const FORMAT: FileFormat = FileFormat {
    magic: *b"cstkbody",
    version: VERSION,
    name: "body file",
};

/// The largest body file, 16 GiB: many times the size of the largest body from a mesh file (see `mesh_budget`).
pub const MAX_FILE_BYTES: u64 = 1 << 34;

impl Body {
    /// Writes the body to a file. An existing file is replaced only after everything is written. Fails for a body with a
    /// support function of the caller.
    pub fn save(&self, path: &Path) -> Result<()> {
        let bytes = self.to_bytes();
        write_whole(path, &bytes.map_err(|error| error.within(path.display()))?)
    }

    /// Reads a body that [`Body::save`] wrote. Its answers equal those of the saved body, bit for bit.
    pub fn load(path: &Path) -> Result<Self> {
        read_whole(path, MAX_FILE_BYTES)
            .and_then(|bytes| Self::from_bytes(&bytes))
            .map_err(|error| error.within(path.display()))
    }

    /// The content of a body file.
    pub fn to_bytes(&self) -> Result<Vec<u8>> {
        let mut payload = Writer::default();
        payload.u32(self.dimension);
        payload.vector(&self.center);
        payload.u64(self.statistics.faces_split);
        payload.u64(self.statistics.faces_dropped);
        payload.vector(&self.statistics.low.into());
        payload.vector(&self.statistics.high.into());
        let times = &self.statistics.times;
        for seconds in [times.preparation, times.grouping, times.construction] {
            payload.f64(seconds);
        }
        payload.primitives(&self.primitives)?;
        payload.wrappers(&self.wrappers, self.statistics.depth);
        payload.packed(&self.packed);
        payload.u32(self.statistics.is_solid.into());
        payload.solid(self.solid.as_ref());
        payload.parts(&self.parts);
        payload.f64(self.stated_deviation);
        Ok(FORMAT.seal(payload.0))
    }

    /// The SHA-256 digest of what the body is, whatever its hierarchy: its primitives with their tags, the solid that they
    /// bound, and the stated deviation. Fails for a body with a support function of the caller.
    pub fn digest(&self) -> Result<[u8; 32]> {
        let mut content = Writer::default();
        content.u32(self.dimension);
        content.vector(&self.center);
        content.primitives(&self.primitives)?;
        content.solid(self.solid.as_ref());
        if self.stated_deviation > 0.0 {
            content.f64(self.stated_deviation);
        }
        Ok(Sha256::digest(content.0).into())
    }

    /// Reads a body from the content of a body file, and checks it.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self> {
        let mut reader = FORMAT.open(bytes)?;
        let dimension = reader.u32()?;
        check_dimension(dimension).map_err(|_| reader.damaged("the dimension"))?;
        let center = reader.vector()?;
        let mut statistics = BodyStatistics {
            faces_split: reader.u64()?,
            faces_dropped: reader.u64()?,
            low: reader.vector()?.into(),
            high: reader.vector()?.into(),
            times: BuildTimes {
                preparation: reader.f64()?,
                grouping: reader.f64()?,
                construction: reader.f64()?,
            },
            ..BodyStatistics::default()
        };
        let primitives = reader.primitives(dimension == 2)?;
        let wrappers;
        (wrappers, [statistics.nodes, statistics.depth]) = reader.wrappers(&primitives)?;
        let packed = reader.packed(&primitives, wrappers.ball(&primitives))?;
        statistics.is_solid = reader.flag()?;
        let solid = reader.solid(&primitives)?;
        let parts = reader.parts(primitives.len(), dimension == 2)?;
        let stated_deviation = reader.length()?;
        reader.end()?;
        statistics.primitives = primitives.len() as u64;
        Ok(Self::assemble(
            dimension,
            center,
            primitives.radius(),
            primitives,
            wrappers,
            packed,
            statistics,
        )
        .with_solid(solid)
        .with_parts(parts)
        .with_stated_deviation(stated_deviation))
    }
}

#[cfg(test)]
mod tests {
    use super::super::builder::BodyBuilder;
    use super::super::file_writer::{KINDS, LEAF};
    use super::*;
    use crate::error::ErrorKind;
    use crate::hierarchy::{HierarchyOptions, WrapperKind};
    use crate::pose::Vec3;
    use crate::sealed_file::HEADER_BYTES;

    fn steps(wrapper: WrapperKind) -> Body {
        let mut builder = BodyBuilder::new(3).unwrap();
        for i in 0..40 {
            let (x, z) = (f64::from(i), 0.3 * f64::from(i % 7));
            let square = [(0., 0.), (1., 0.), (1., 1.), (0., 1.)];
            let square = square.map(|(u, v)| Vec3::new(x + u, v, z));
            builder
                .add_polygon(&square, u64::from(i as u32) + 100)
                .unwrap();
        }
        builder
            .add_polyhedron(
                &(0..8)
                    .map(|i| {
                        Vec3::new(
                            f64::from(i & 1),
                            f64::from(i >> 1 & 1),
                            f64::from(i >> 2) - 3.0,
                        )
                    })
                    .collect::<Vec<_>>(),
                7,
            )
            .unwrap();
        let at = crate::pose::Pose::from_translation(Vec3::new(0.3, 0.1, 5.0));
        builder
            .add_capsule(&Vec3::zeros(), &Vec3::x(), 0.3, 8)
            .unwrap();
        builder.add_cylinder(&at, 0.5, 1.0, 9).unwrap();
        builder.add_cone(&at, 0.5, 1.0, 10).unwrap();
        builder
            .add_ellipsoid(&at, &Vec3::new(0.1, 0.2, 0.3), 11)
            .unwrap();
        let options = HierarchyOptions {
            wrapper,
            ..Default::default()
        };
        builder.build(&options, &mut |_| Ok(())).unwrap()
    }

    #[test]
    fn a_loaded_body_is_the_saved_one() {
        for kind in KINDS {
            let saved = steps(kind);
            let loaded = Body::from_bytes(&saved.to_bytes().unwrap()).unwrap();
            assert_eq!(loaded.tree(), saved.tree());
            assert_eq!(loaded.packed, saved.packed);
            assert_eq!(loaded.primitives, saved.primitives);
            assert_eq!(loaded.center, saved.center);
            assert_eq!(loaded.radius, saved.radius);
            assert_eq!(loaded.deviation, saved.deviation);
            assert_eq!(loaded.stated_deviation, saved.stated_deviation);
            assert_eq!(loaded.statistics.depth, saved.statistics.depth);
            assert_ne!(loaded.serial(), saved.serial());
        }
    }

    #[test]
    fn every_truncation_and_every_flipped_bit_is_refused() {
        let bytes = steps(WrapperKind::Hull).to_bytes().unwrap();
        for length in 0..bytes.len() {
            assert!(
                Body::from_bytes(&bytes[..length]).is_err(),
                "{length} bytes"
            );
        }
        let mut altered = bytes.clone();
        for place in 0..bytes.len() {
            altered[place] ^= 1 << (place % 8);
            assert!(Body::from_bytes(&altered).is_err(), "byte {place}");
            altered[place] = bytes[place];
        }
        altered.push(0);
        assert!(Body::from_bytes(&altered).is_err());
        altered = bytes;
        altered[8] = 8;
        let error = Body::from_bytes(&altered).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Unsupported);
        assert!(error.message.contains("version 8"), "{}", error.message);
    }

    /// Forged content that passes the checksum must not cause reads out of bounds.
    #[test]
    fn forged_content_is_refused_or_harmless() {
        let bytes = steps(WrapperKind::Hull).to_bytes().unwrap();
        for place in (HEADER_BYTES..bytes.len()).step_by(4) {
            for value in [u32::MAX, 0, LEAF | 44, 3] {
                let mut forged = bytes.clone();
                let end = (place + 4).min(bytes.len());
                forged[place..end].copy_from_slice(&value.to_le_bytes()[..end - place]);
                let sum = crc32fast::hash(&forged[HEADER_BYTES..]);
                forged[24..28].copy_from_slice(&sum.to_le_bytes());
                let sum = crc32fast::hash(&forged[..28]);
                forged[28..32].copy_from_slice(&sum.to_le_bytes());
                if let Ok(body) = Body::from_bytes(&forged) {
                    assert_eq!(body.tree().level(0), vec![0]);
                    assert!(body.tree().subsets().is_sound(body.primitives().len()));
                }
            }
        }
    }
}
