//! Certificate files: docs/certificate-file.md describes the format.

use std::path::Path;

use super::certificate::{Certificate, Entry, Step};
use crate::error::Result;
use crate::sealed_file::{FileFormat, Reader, Writer};
use crate::whole_file::{read_whole, write_whole};

const FORMAT: FileFormat = FileFormat {
    magic: *b"cstkcert",
    version: 1,
    name: "certificate file",
};

/// The largest certificate file, 4 GiB: several times what a search may find.
const MAX_FILE_BYTES: u64 = 1 << 32;

/// The bytes of an entry.
const ENTRY_BYTES: usize = 10 * 4 + 7 * 8;

impl Certificate {
    /// Writes it to a file. An existing file is replaced only after everything is written.
    pub fn save(&self, path: &Path) -> Result<()> {
        write_whole(path, &self.to_bytes())
    }

    /// Reads what [`Certificate::save`] wrote. A certificate proves nothing before it is verified, wherever it comes from.
    pub fn load(path: &Path) -> Result<Self> {
        read_whole(path, MAX_FILE_BYTES)
            .and_then(|bytes| Self::from_bytes(&bytes))
            .map_err(|error| error.within(path.display()))
    }

    /// The content of a certificate file.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut content = Writer::default();
        content.f64(self.threshold);
        content.count(self.ends[0].len());
        for end in &self.ends {
            content.numbers(end);
        }
        content.0.extend(self.fingerprint);
        content.count(self.orders.len());
        for order in &self.orders {
            content.count(order.len());
            order.iter().for_each(|primitive| content.u32(*primitive));
        }
        content.count(self.steps.len());
        self.steps.iter().for_each(|step| content.u32(step.0));
        content.count(self.entries.len());
        self.entries.iter().for_each(|entry| content.entry(entry));
        FORMAT.seal(content.0)
    }

    /// Reads a certificate from the content of a certificate file.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self> {
        let mut reader = FORMAT.open(bytes)?;
        let threshold = reader.length()?;
        let nq = reader.count(16)?;
        let mut configuration = || (0..nq).map(|_| reader.f64()).collect::<Result<Vec<f64>>>();
        let ends = [configuration()?, configuration()?];
        let fingerprint = reader.take()?;
        // An order has at least its number of primitives.
        let orders = reader.count(8)?;
        let orders = (0..orders).map(|_| {
            let primitives = reader.count(4)?;
            (0..primitives).map(|_| reader.index(primitives)).collect()
        });
        let orders = orders.collect::<Result<Vec<Vec<u32>>>>()?;
        let steps = reader.count(4)?;
        let steps = (0..steps).map(|_| Ok(Step(reader.u32()?)));
        let steps = steps.collect::<Result<Vec<Step>>>()?;
        let entries = reader.count(ENTRY_BYTES)?;
        let entries = (0..entries).map(|_| reader.entry());
        let entries = entries.collect::<Result<Vec<Entry>>>()?;
        reader.end()?;
        if steps.iter().filter(|step| **step == Step::PROVED).count() != entries.len() {
            return Err(reader.damaged("the number of entries"));
        }
        let certificate = Self {
            ends,
            threshold,
            fingerprint,
            orders,
            steps,
            entries,
        };
        Ok(certificate)
    }
}

impl Writer {
    fn entry(&mut self, entry: &Entry) {
        self.u32(entry.item);
        let numbers = entry.links.iter().chain(&entry.bodies);
        for number in numbers.chain(entry.groups.as_flattened()) {
            self.u32(*number);
        }
        self.u32(entry.carrier);
        self.numbers(&entry.times);
        self.numbers(&entry.direction);
        self.f64(entry.gap);
        self.f64(entry.displacement);
    }
}

impl Reader<'_> {
    fn entry(&mut self) -> Result<Entry> {
        Ok(Entry {
            item: self.u32()?,
            links: [self.u32()?, self.u32()?],
            bodies: [self.u32()?, self.u32()?],
            groups: [[self.u32()?, self.u32()?], [self.u32()?, self.u32()?]],
            carrier: self.u32()?,
            times: [self.f64()?, self.f64()?],
            direction: self.vector()?.into(),
            gap: self.f64()?,
            displacement: self.length()?,
        })
    }
}
