//! Certificates that are altered as a forger would: in their files, with checksums that are right.

use cstk::certificate::{Certificate, Entry};

const ENTRY: usize = 96;
const PROVED: u32 = 0;
const HALVE_TIME: u32 = 1;

/// The parts of a certificate file.
#[derive(Clone)]
pub struct Forged {
    /// All before the steps.
    head: Vec<u8>,
    steps: Vec<u32>,
    entries: Vec<Vec<u8>>,
}

fn number(bytes: &[u8], at: usize) -> usize {
    u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap()) as usize
}

impl Forged {
    pub fn of(certificate: &Certificate) -> Self {
        let bytes = certificate.to_bytes();
        let nq = number(&bytes, 40);
        let mut at = 48 + 16 * nq + 32;
        let bodies = number(&bytes, at);
        at += 8;
        for _ in 0..bodies {
            at += 8 + 4 * number(&bytes, at);
        }
        let count = number(&bytes, at);
        let steps = bytes[at + 8..at + 8 + 4 * count].chunks_exact(4);
        let steps = steps.map(|step| u32::from_le_bytes(step.try_into().unwrap()));
        let entries = bytes[at + 16 + 4 * count..].chunks_exact(ENTRY);
        Self {
            head: bytes[..at].to_vec(),
            steps: steps.collect(),
            entries: entries.map(<[u8]>::to_vec).collect(),
        }
    }

    pub fn certificate(&self) -> Certificate {
        let mut bytes = self.head.clone();
        bytes.extend((self.steps.len() as u64).to_le_bytes());
        bytes.extend(self.steps.iter().flat_map(|step| step.to_le_bytes()));
        bytes.extend((self.entries.len() as u64).to_le_bytes());
        bytes.extend(self.entries.concat());
        helpers::files::sign(&mut bytes);
        Certificate::from_bytes(&bytes).unwrap()
    }

    /// Sets the first or the last configuration.
    pub fn set_end(&mut self, end: usize, q: &[f64]) {
        for (k, x) in q.iter().enumerate() {
            let at = 48 + 8 * (end * q.len() + k);
            self.head[at..at + 8].copy_from_slice(&x.to_le_bytes());
        }
    }

    pub fn entry(&self, place: usize) -> Entry {
        let bytes = &self.entries[place];
        let whole = |k: usize| u32::from_le_bytes(bytes[4 * k..][..4].try_into().unwrap());
        let real = |k: usize| f64::from_le_bytes(bytes[40 + 8 * k..][..8].try_into().unwrap());
        Entry {
            item: whole(0),
            links: [whole(1), whole(2)],
            bodies: [whole(3), whole(4)],
            groups: [[whole(5), whole(6)], [whole(7), whole(8)]],
            carrier: whole(9),
            times: [real(0), real(1)],
            direction: [real(2), real(3), real(4)],
            gap: real(5),
            displacement: real(6),
        }
    }

    pub fn set_entry(&mut self, place: usize, entry: &Entry) {
        let wholes = [
            &[entry.item][..],
            &entry.links,
            &entry.bodies,
            entry.groups.as_flattened(),
            &[entry.carrier],
        ];
        let reals = [
            &entry.times[..],
            &entry.direction,
            &[entry.gap, entry.displacement],
        ];
        let mut bytes: Vec<u8> = wholes
            .concat()
            .iter()
            .flat_map(|x| x.to_le_bytes())
            .collect();
        bytes.extend(reals.concat().iter().flat_map(|x| x.to_le_bytes()));
        self.entries[place] = bytes;
    }

    pub fn step_mut(&mut self, place: usize, change: impl FnOnce(&mut u32)) {
        change(&mut self.steps[place]);
        // The number of entries must fit.
        let proved = self.steps.iter().filter(|step| **step == PROVED).count();
        let last = self.entries[0].clone();
        self.entries.resize(proved, last);
    }

    /// The step that an entry belongs to.
    fn step_of(&self, entry: usize) -> usize {
        let steps = self.steps.iter().enumerate();
        let mut proved = steps.filter(|(_, step)| **step == PROVED);
        proved.nth(entry).unwrap().0
    }

    /// Removes an entry with its step.
    pub fn remove_entry(&mut self, place: usize) {
        self.steps.remove(self.step_of(place));
        self.entries.remove(place);
    }

    /// Makes an entry and the one after it, where they are the halves of an interval, the first alone over the whole of it.
    pub fn joined(&mut self, place: usize) -> Option<[f64; 2]> {
        if place + 1 >= self.entries.len() {
            return None;
        }
        let step = self.step_of(place);
        let pattern = [HALVE_TIME, PROVED, PROVED];
        if step == 0 || self.steps.get(step - 1..step + 2) != Some(&pattern[..]) {
            return None;
        }
        self.steps.splice(step - 1..step + 2, [PROVED]);
        let next = self.entry(place + 1);
        let mut entry = self.entry(place);
        entry.times[1] = next.times[1];
        self.set_entry(place, &entry);
        self.entries.remove(place + 1);
        Some(entry.times)
    }
}
