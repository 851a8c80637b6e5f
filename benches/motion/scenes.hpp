// The scenes of the benchmark.
#pragma once

#include "scene.hpp"

#include <memory>
#include <string>
#include <vector>

using Scenes = std::vector<std::unique_ptr<Scene>>;

/// Bodies that move freely among others, from the files of the example write_scenes. The length of a motion is its metres and its
/// radians together, one half each.
void add_rigid_scenes(const std::string &folder, Scenes &scenes);

/// The Puma 560 in its workcell, from the meshes of scripts/fetch_puma560.sh.
void add_puma_scene(const std::string &folder, Scenes &scenes);

/// The Panda and the UR10 of example-robot-data among boxes and in front of a shelf.
void add_urdf_scenes(const std::string &folder, Scenes &scenes);

/// The Puma 560 beside a thin plate that its motion keeps a clearance from, or reaches into by a little.
void add_plate_scenes(const std::string &puma_folder, Scenes &scenes);
