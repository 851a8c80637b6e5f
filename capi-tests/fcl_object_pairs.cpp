// Objects against objects, within an environment and between two, against FCL's DynamicAABBTreeCollisionManager with itself and with
// another: boxes and balls at random poses, moved between the questions. Which pairs meet must agree, but for those whose gap is
// below what FCL's solvers resolve; so must the least distance.
#include "fcl_common.hpp"

namespace {

const double resolved = 1e-6;

// A box or a ball as both libraries hold it.
struct Item {
    std::uint64_t id;
    cstk_body *body;
    Handle<cstk_body> kept;
    std::unique_ptr<fcl::CollisionObjectd> object;
    double pose[12];
};

struct Set {
    Set(std::size_t count, models::Random &random) {
        cstk_environment *made = nullptr;
        must(cstk_environment_create(&made));
        environment.reset(made);
        for (std::size_t i = 0; i < count; ++i) {
            add(i % 3 == 0, random);
        }
        manager.setup();
    }

    void add(bool ball, models::Random &random) {
        const double half[3] = {random.uniform(0.02, 0.1), random.uniform(0.02, 0.1), random.uniform(0.02, 0.1)};
        const double origin[3] = {0, 0, 0}, identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
        cstk_body_builder *builder = nullptr;
        cstk_environment_change change;
        Item item = {};
        must(cstk_body_builder_create(3, &builder));
        const Handle<cstk_body_builder> kept(builder);
        must(ball ? cstk_body_builder_add_sphere(builder, origin, half[0], 0)
                  : cstk_body_builder_add_box(builder, identity, half, 0));
        must(cstk_body_build(builder, nullptr, nullptr, nullptr, &item.body));
        item.kept.reset(item.body);
        must(cstk_environment_change_default(&change, sizeof change));
        change.body = item.body;
        must(cstk_environment_apply(environment.get(), &change, 1, &item.id, nullptr));
        std::shared_ptr<fcl::CollisionGeometryd> shape;
        if (ball) {
            shape = std::make_shared<fcl::Sphered>(half[0]);
        } else {
            shape = std::make_shared<fcl::Boxd>(2 * half[0], 2 * half[1], 2 * half[2]);
        }
        item.object = std::make_unique<fcl::CollisionObjectd>(shape);
        items.push_back(std::move(item));
        items.back().object->setUserData(reinterpret_cast<void *>(items.back().id));
        manager.registerObject(items.back().object.get());
    }

    // Each to a pose within a cube.
    void move(double within, models::Random &random) {
        for (Item &item : items) {
            const models::Point axis = random.direction();
            const double half_turn = random.uniform(0, models::pi), s = std::sin(half_turn);
            const double given[7] = {random.uniform(-within, within), random.uniform(-within, within),
                                     random.uniform(-within, within), s * axis[0], s * axis[1], s * axis[2],
                                     std::cos(half_turn)};
            must(cstk_pose_from_quaternion(given, item.pose));
            cstk_environment_change change;
            must(cstk_environment_change_default(&change, sizeof change));
            change.kind = CSTK_CHANGE_MOVE;
            change.id = item.id;
            fcl::Transform3d at = fcl::Transform3d::Identity();
            for (int i = 0; i < 12; ++i) {
                change.pose[i] = item.pose[i];
                at.matrix()(i / 4, i % 4) = item.pose[i];
            }
            must(cstk_environment_apply(environment.get(), &change, 1, nullptr, nullptr));
            item.object->setTransform(at);
            item.object->computeAABB();
        }
        manager.update();
    }

    const Item &find(std::uint64_t id) const {
        return *std::find_if(items.begin(), items.end(), [id](const Item &item) { return item.id == id; });
    }

    Handle<cstk_environment> environment;
    std::vector<Item> items;
    fcl::DynamicAABBTreeCollisionManagerd manager;
};

using Pairs = std::set<std::pair<std::uint64_t, std::uint64_t>>;

std::pair<std::uint64_t, std::uint64_t> ids_of(fcl::CollisionObjectd *a, fcl::CollisionObjectd *b) {
    const auto i = reinterpret_cast<std::uint64_t>(a->getUserData()), j = reinterpret_cast<std::uint64_t>(b->getUserData());
    return {std::min(i, j), std::max(i, j)};
}

bool add_meeting(fcl::CollisionObjectd *a, fcl::CollisionObjectd *b, void *data) {
    fcl::CollisionResultd result;
    if (fcl::collide(a, b, fcl::CollisionRequestd(1, false), result) > 0) {
        static_cast<Pairs *>(data)->insert(ids_of(a, b));
    }
    return false;
}

bool lower_least(fcl::CollisionObjectd *a, fcl::CollisionObjectd *b, void *data, double &bound) {
    fcl::DistanceRequestd request(false);
    request.gjk_solver_type = fcl::GST_INDEP;
    fcl::DistanceResultd result;
    fcl::distance(a, b, request, result);
    double &least = *static_cast<double *>(data);
    least = std::min(least, std::max(result.min_distance, 0.0));
    bound = least;
    return least <= 0;
}

struct Totals {
    std::size_t pairs = 0, doubtful = 0, wrong = 0, distances = 0;
};

// Whether a pair is too near to touching, or too shallow, for FCL.
bool is_doubtful(cstk_query *query, const Item &a, const Item &b) {
    cstk_distance_result found;
    must(cstk_pair_distance(query, a.body, a.pose, b.body, b.pose, INFINITY, &found));
    if (found.distance > 0) {
        return found.distance < resolved;
    }
    cstk_penetration_list deep;
    must(cstk_pair_penetration(query, a.body, a.pose, b.body, b.pose, 1, &deep));
    return deep.count == 0 || deep.penetrations[0].depth < resolved;
}

void compare(cstk_query *query, Set &a, Set *b, Totals &totals) {
    cstk_object_pair_list list;
    const Handle<cstk_query> judge = make_query();
    must(cstk_environment_pairs(query, a.environment.get(), b ? b->environment.get() : nullptr, 0, SIZE_MAX, nullptr, &list));
    Pairs ours, theirs, differing;
    for (std::size_t i = 0; i < list.count; ++i) {
        const auto [low, high] = std::minmax(list.pairs[i].r_object, list.pairs[i].s_object);
        ours.insert({low, high});
    }
    b ? a.manager.collide(&b->manager, &theirs, add_meeting) : a.manager.collide(&theirs, add_meeting);
    std::set_symmetric_difference(ours.begin(), ours.end(), theirs.begin(), theirs.end(),
                                  std::inserter(differing, differing.end()));
    for (const auto &[low, high] : differing) {
        const bool doubtful = is_doubtful(judge.get(), a.find(low), (b ? *b : a).find(high));
        doubtful ? ++totals.doubtful : ++totals.wrong;
    }
    totals.pairs += ours.size();
    if (!ours.empty()) {
        return;
    }
    cstk_distance_result nearest;
    double least = std::numeric_limits<double>::max();
    must(cstk_environment_distance(query, a.environment.get(), b ? b->environment.get() : nullptr, INFINITY, nullptr, &nearest));
    b ? a.manager.distance(&b->manager, &least, lower_least) : a.manager.distance(&least, lower_least);
    ++totals.distances;
    totals.wrong += !(std::fabs(least - nearest.distance) <= resolved);
}

} // namespace

int main() {
    models::Random random(21);
    Totals totals;
    const Handle<cstk_query> query = make_query();
    for (const std::size_t count : {4u, 30u, 150u}) {
        Set a(count, random), b(count / 2, random);
        for (int round = 0; round < 40; ++round) {
            const double within = round % 2 == 0 ? 0.6 : 3;
            a.move(within, random);
            b.move(within, random);
            compare(query.get(), a, nullptr, totals);
            compare(query.get(), a, &b, totals);
        }
    }
    std::printf("%zu pairs met, %zu least distances; %zu differ, and %zu that touch\n", totals.pairs, totals.distances,
                totals.wrong, totals.doubtful);
    return totals.wrong == 0 && totals.pairs > 1000 && totals.distances > 30 ? 0 : 1;
}
