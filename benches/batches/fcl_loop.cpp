#include "peers.hpp"

#include "fcl_cell.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>

namespace {

// As in the library: neighbouring configurations go to one thread.
const std::size_t run_length = 64;

PeerAnswers ask(const std::vector<std::shared_ptr<const FclCell>> &cells, const std::vector<double> &q, std::size_t count,
                std::size_t nq) {
    PeerAnswers answers(count);
    std::atomic<std::size_t> next{0};
    const auto work = [&](const FclCell &cell) {
        for (std::size_t first; (first = next.fetch_add(run_length)) < count;) {
            for (std::size_t i = first; i < std::min(first + run_length, count); ++i) {
                answers[i] = cell.meets({q.data() + i * nq, nq}) ? 1 : 0;
            }
        }
    };
    std::vector<std::thread> helpers;
    for (std::size_t i = 1; i < cells.size(); ++i) {
        helpers.emplace_back(work, std::cref(*cells[i]));
    }
    work(*cells[0]);
    for (std::thread &helper : helpers) {
        helper.join();
    }
    return answers;
}

} // namespace

std::vector<PeerBatch> fcl_loops(const problems::Workcell &workcell) {
    const std::string way = FclCell::fastest_way(workcell);
    const std::size_t nq = workcell.space.nq();
    std::vector<PeerBatch> made;
    std::vector<std::shared_ptr<const FclCell>> cells;
    for (std::size_t threads = 1; threads <= 2; ++threads) {
        cells.push_back(std::make_shared<const FclCell>(workcell, way));
        made.push_back({"FCL (" + way + ") on " + std::to_string(threads),
                        [=](const std::vector<double> &q, std::size_t count) { return ask(cells, q, count, nq); }});
    }
    return made;
}
