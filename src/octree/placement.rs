//! An octree in an environment: the objects of its tiles, and how they follow the cells.

use std::sync::Arc;

use super::cells::{Cells, Cube, WHOLE};
use super::cubes::steps;
use super::tile_bodies::TileBodies;
use super::tiles::{TILE_LEVEL, Tile, Tiles, outdated, within};
use crate::environment::{Addition, Change, Environment};
use crate::error::Result;
use crate::pose::{Pose, Vec3};
use crate::tolerance::EPSILON;
use crate::user_data::UserData;

/// Where an octree is.
#[derive(Debug)]
pub struct Placement {
    environment: Arc<Environment>,
    pose: Pose,
    data: Option<UserData>,
    tiles: Tiles,
    bodies: TileBodies,
}

impl Placement {
    /// Adds the tiles of the cells to an environment, in one change.
    pub fn new(
        environment: &Arc<Environment>,
        pose: &Pose,
        data: Option<UserData>,
        cells: &Cells,
        resolution: f64,
    ) -> Result<Self> {
        let mut placement = Self {
            environment: environment.clone(),
            pose: *pose,
            data,
            tiles: Tiles::new(),
            bodies: TileBodies::default(),
        };
        // Also of no tiles, so that an environment that refuses changes is refused at once.
        placement.replace(cells, resolution, &[WHOLE], pose)?;
        Ok(placement)
    }

    /// The number of objects.
    pub fn object_count(&self) -> usize {
        self.tiles.len()
    }

    /// Follows changes of some cubes' cells, in one change of the environment.
    pub fn follow(&mut self, cells: &Cells, resolution: f64, changed: &[Cube]) -> Result<()> {
        let cubes = outdated(&self.tiles, cells, changed);
        let pose = self.pose;
        match cubes.is_empty() {
            true => Ok(()),
            false => self.replace(cells, resolution, &cubes, &pose),
        }
    }

    /// Moves all objects, in one change. Those that have to reach over their neighbours by more or by less than before are made anew.
    pub fn move_to(&mut self, pose: &Pose, cells: &Cells, resolution: f64) -> Result<()> {
        let tiles = self.tiles.values();
        let changed = tiles.filter(|tile| {
            let by = |pose: &Pose| overlap(pose, tile.cube, resolution);
            by(pose) != by(&self.pose)
        });
        let changed: Vec<Cube> = changed.map(|tile| tile.cube).collect();
        self.replace(cells, resolution, &changed, pose)
    }

    /// Deletes all objects, in one change.
    pub fn remove(&mut self) -> Result<()> {
        let deletions = self.deletions(self.tiles.values().copied());
        self.environment.apply(&deletions)?;
        self.tiles.clear();
        Ok(())
    }

    /// Makes the tiles within cubes anew, and moves the others if the pose is another.
    fn replace(
        &mut self,
        cells: &Cells,
        resolution: f64,
        cubes: &[Cube],
        pose: &Pose,
    ) -> Result<()> {
        let old: Vec<(u64, Tile)> = cubes
            .iter()
            .flat_map(|&cube| within(&self.tiles, cube))
            .collect();
        let mut new = Vec::new();
        for &cube in cubes {
            cells.visit(cube, TILE_LEVEL, &mut |tile| new.push(tile));
        }
        let mut changes = self.deletions(old.iter().map(|(_, tile)| *tile));
        let deleted = changes.len();
        for &cube in &new {
            let overlap = overlap(pose, cube, resolution);
            let body = self.bodies.body(cells, cube, resolution, overlap)?;
            changes.push(Change::Add(Addition {
                data: self.data.clone(),
                ..Addition::new(body, pose_of(pose, cube, resolution))
            }));
        }
        if *pose != self.pose {
            changes.extend(self.moves(&old, pose, resolution));
        }
        let (ids, _) = self.environment.apply(&changes)?;
        self.pose = *pose;
        for (place, _) in old {
            self.tiles.remove(&place);
        }
        for (cube, &id) in new.into_iter().zip(&ids[deleted..]) {
            let place = super::tiles::place_of(cube.low);
            self.tiles.insert(place, Tile { cube, id });
        }
        self.bodies.prune();
        Ok(())
    }

    /// The moves of all tiles but some, which are in order of their places.
    fn moves(&self, others: &[(u64, Tile)], pose: &Pose, resolution: f64) -> Vec<Change> {
        let now = self.environment.snapshot();
        let is_other = |place: &u64| others.binary_search_by_key(place, |(p, _)| *p).is_ok();
        let tiles = self.tiles.iter().filter(|(place, _)| !is_other(place));
        let present = tiles.filter(|(_, tile)| now.find(tile.id).is_some());
        let moves = present.map(|(_, tile)| Change::Move {
            id: tile.id,
            pose: pose_of(pose, tile.cube, resolution),
        });
        moves.collect()
    }

    /// The deletions of those tiles' objects that are still there.
    fn deletions(&self, tiles: impl Iterator<Item = Tile>) -> Vec<Change> {
        let now = self.environment.snapshot();
        let present = tiles.filter(|tile| now.find(tile.id).is_some());
        present.map(|tile| Change::Delete { id: tile.id }).collect()
    }
}

/// How far a tile's cells reach over its neighbours', so that no rounding of their places leaves a gap between tiles. The lowest corner
/// is a product, and its place a sum of three more and the pose's own: 4 EPSILON of their lengths is more than their rounding. To a power
/// of two, so that many tiles share a body, and most moves keep it.
fn overlap(pose: &Pose, tile: Cube, resolution: f64) -> f64 {
    let length = pose.translation.norm() + steps(tile.low).norm() * resolution;
    4.0 * EPSILON * length.log2().ceil().exp2()
}

/// The pose of a tile's body.
fn pose_of(pose: &Pose, tile: Cube, resolution: f64) -> Pose {
    let low: Vec3 = steps(tile.low) * resolution;
    Pose {
        translation: pose.transform_point(&low),
        ..*pose
    }
}
