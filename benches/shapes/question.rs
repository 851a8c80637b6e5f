//! What is asked of two bodies.

use super::ours::Ours;
use super::placement::Placement;

#[derive(Clone, Copy, PartialEq)]
pub enum Query {
    Distance,
    /// Within a part of the distance.
    Within(f64),
    Collide,
    /// Pairs of primitives that meet, at most so many of them.
    Contacts(usize),
}

impl Query {
    pub fn name(self) -> String {
        match self {
            Query::Distance => "distance".into(),
            Query::Within(part) => format!("within {part} d"),
            Query::Collide => "collide".into(),
            Query::Contacts(most) => format!("contacts {most}"),
        }
    }
}

/// A query at all poses of a row.
pub struct Question {
    pub query: Query,
    pub placed: Vec<Placement>,
    /// One for each pose: the thresholds of `Within`.
    pub thresholds: Vec<f64>,
}

impl Question {
    pub fn new(query: Query, placed: Vec<Placement>, ours: &Ours) -> Self {
        let part = match query {
            Query::Within(part) => part,
            _ => 0.0,
        };
        let threshold = |at: &Placement| match part {
            0.0 => 0.0,
            part => part * ours.distance(at),
        };
        Self {
            query,
            thresholds: placed.iter().map(threshold).collect(),
            placed,
        }
    }
}
