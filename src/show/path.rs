//! A robot that moves along a path.

use std::path::Path as FilePath;

use serde_json::json;

use super::bodies::shown_bodies;
use super::glb::{Document, require_glb};
use crate::cobject::CObject;
use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::pose::Pose;
use crate::query::World;
use crate::space::Space;

/// Between two moments the robot goes at most this part of the path: viewers turn and shift each link by itself, along no joint.
const LONGEST_PART: f64 = 1.0 / 240.0;

/// More points than this are not shown: a picture of so many moments helps nobody.
const MAX_POINTS: usize = 10_000;

/// Writes the links, which move along a path, and the s-objects. `points` holds one configuration after the other, which the robot passes
/// within `seconds` at constant speed, as [`Space::distance`] measures. The file is written whole or not at all.
pub fn show_path(cobject: &CObject, points: &[f64], seconds: f64, file: &FilePath) -> Result<()> {
    require_glb(file)?;
    let space = cobject.space();
    require_coordinates(&[seconds], "seconds")?;
    if seconds <= 0.0 {
        return Err(Error::invalid(format!(
            "seconds is {seconds}; it must be larger than 0"
        )));
    }
    let moments = moments(space, points, seconds)?;
    let world = &World::of(cobject);
    let mut document = Document::default();
    let shown = shown_bodies(world, cobject, &mut document);
    let mut links: Vec<Vec<Pose>> = vec![Vec::with_capacity(moments.len()); space.link_count()];
    for (_, q) in &moments {
        for (link, pose) in links.iter_mut().zip(space.link_poses(q)?) {
            link.push(pose);
        }
    }
    let times = document.add_times(&moments.iter().map(|(time, _)| *time).collect::<Vec<_>>());
    for body in shown {
        let Some(link) = body.link else {
            document.add_node(&body.name, body.mesh, &body.pose, body.extras);
            continue;
        };
        let placed = links[link].iter().map(|pose| pose.compose(&body.pose));
        let poses: Vec<Pose> = placed.collect();
        document.add_moving_node(&body.name, body.mesh, (times, &poses), body.extras);
    }
    let extras = json!({ "points": points.len() / space.nq().max(1), "seconds": seconds });
    document.save(file, extras)
}

/// The times and the configurations at them: all points, and some between points that are far apart.
fn moments(space: &Space, points: &[f64], seconds: f64) -> Result<Vec<(f64, Vec<f64>)>> {
    let nq = space.nq();
    if nq == 0 || points.is_empty() || !points.len().is_multiple_of(nq) {
        return Err(Error::new(
            ErrorKind::WrongSize,
            format!(
                "the path has {} numbers, which are not one or more points of {nq} coordinates",
                points.len()
            ),
        ));
    }
    let count = points.len() / nq;
    if count > MAX_POINTS {
        return Err(Error::new(
            ErrorKind::WrongSize,
            format!("{count} points are more than {MAX_POINTS}"),
        ));
    }
    let points: Vec<&[f64]> = points.chunks(nq).collect();
    for (i, q) in points.iter().enumerate() {
        let checked = space.check_configuration(q);
        checked.map_err(|error| error.within(format_args!("point {i}")))?;
    }
    let pairs = points.windows(2);
    let lengths: Vec<f64> = pairs
        .map(|two| space.distance(two[0], two[1], None))
        .collect();
    let whole: f64 = lengths.iter().sum();
    let mut moments = vec![(0.0, points[0].to_vec())];
    let mut before = 0.0;
    for (two, length) in points.windows(2).zip(&lengths) {
        // Times rise: what rests takes none.
        if *length == 0.0 {
            continue;
        }
        let parts = (length / (LONGEST_PART * whole)).ceil().max(1.0);
        for k in 1..=parts as usize {
            let part = k as f64 / parts;
            let time = seconds * ((before + part * length) / whole).min(1.0);
            if moments
                .last()
                .is_some_and(|(last, _)| time as f32 > *last as f32)
            {
                moments.push((time, space.interpolate(two[0], two[1], part)));
            }
        }
        before += length;
    }
    Ok(moments)
}
