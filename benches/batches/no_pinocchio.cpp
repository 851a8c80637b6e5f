#include "peers.hpp"

std::vector<PeerBatch> pinocchio_batches(const problems::Workcell &) { return {}; }
