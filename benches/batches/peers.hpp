// The same cells by other libraries: whether anything meets, at many configurations on several threads.
#pragma once

#include "problem.hpp"

#include <functional>
#include <string>
#include <vector>

/// Whether anything meets at each of `count` configurations.
using PeerAnswers = std::vector<char>;

struct PeerBatch {
    std::string name;
    std::function<PeerAnswers(const std::vector<double> &q, std::size_t count)> ask;
};

/// FCL in a loop: its fastest way for the cell, one a thread. The links are placed by this library.
std::vector<PeerBatch> fcl_loops(const problems::Workcell &workcell);

/// Pinocchio's computeCollisionsInParallel, with Coal: meshes with OBBRSS, boxes as shapes, the first collision of a configuration ends
/// it; of pairs in turn or by a tree of boxes, whichever took less time for some random configurations. None where the program was
/// built without it.
std::vector<PeerBatch> pinocchio_batches(const problems::Workcell &workcell);
