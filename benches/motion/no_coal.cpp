#include "peer.hpp"

std::vector<PeerWay> coal_ways(const PeerScene &) { return {}; }
