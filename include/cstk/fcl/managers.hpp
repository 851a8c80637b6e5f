/* Part of cstk/fcl.hpp: broad-phase managers, and the callbacks that FCL brings. */
#ifndef CSTK_FCL_MANAGERS_HPP
#define CSTK_FCL_MANAGERS_HPP

#include <cstk/fcl/continuous_collision.hpp>
#include <cstk/fcl/object_tree.hpp>

#include <cassert>

namespace cstk_fcl {

/// Is given a pair of objects whose boxes meet; returns true to end the search.
template <typename S> using CollisionCallBack = bool (*)(CollisionObject<S> *o1, CollisionObject<S> *o2, void *cdata);

/// Is given a pair of objects that may be nearer than `dist`, and lowers it to their distance; returns true to end the search.
template <typename S>
using DistanceCallBack = bool (*)(CollisionObject<S> *o1, CollisionObject<S> *o2, void *cdata, S &dist);

/// Finds the pairs of many objects that may meet or be nearest, and hands them to a callback. It holds addresses: objects are the
/// caller's. Call update() after objects have moved (and their computeAABB()). Threads may search at once.
template <typename S> class BroadPhaseCollisionManager {
public:
    virtual ~BroadPhaseCollisionManager() = default;

    virtual void registerObjects(const std::vector<CollisionObject<S> *> &objects) {
        for (CollisionObject<S> *object : objects) {
            registerObject(object);
        }
    }
    virtual void registerObject(CollisionObject<S> *object) = 0;
    virtual void unregisterObject(CollisionObject<S> *object) = 0;
    virtual void setup() = 0;
    virtual void update() = 0;
    virtual void update(CollisionObject<S> * /* object */) { update(); }
    virtual void update(const std::vector<CollisionObject<S> *> & /* objects */) { update(); }
    virtual void clear() = 0;
    virtual void getObjects(std::vector<CollisionObject<S> *> &objects) const = 0;

    /// One object with all of the manager; the manager's come first in the callback.
    virtual void collide(CollisionObject<S> *object, void *cdata, CollisionCallBack<S> callback) const = 0;
    virtual void distance(CollisionObject<S> *object, void *cdata, DistanceCallBack<S> callback) const = 0;
    /// All pairs within the manager, each once.
    virtual void collide(void *cdata, CollisionCallBack<S> callback) const = 0;
    virtual void distance(void *cdata, DistanceCallBack<S> callback) const = 0;
    /// All of this manager with all of another; this one's come first.
    virtual void collide(BroadPhaseCollisionManager *other, void *cdata, CollisionCallBack<S> callback) const = 0;
    virtual void distance(BroadPhaseCollisionManager *other, void *cdata, DistanceCallBack<S> callback) const = 0;

    virtual bool empty() const = 0;
    virtual std::size_t size() const = 0;
};

using BroadPhaseCollisionManagerf = BroadPhaseCollisionManager<float>;
using BroadPhaseCollisionManagerd = BroadPhaseCollisionManager<double>;

/// The one manager: a tree of boxes. FCL's settings are accepted and ignored. Distances are searched nearest boxes first.
template <typename S> class DynamicAABBTreeCollisionManager : public BroadPhaseCollisionManager<S> {
public:
    using Object = CollisionObject<S>;

    int max_tree_nonbalanced_level = 10;
    int tree_incremental_balance_pass = 10;
    int tree_topdown_balance_threshold = 2;
    int tree_topdown_level = 0;
    int tree_init_level = 0;
    bool octree_as_geometry_collide = true;
    bool octree_as_geometry_distance = false;

    using BroadPhaseCollisionManager<S>::update;

    /// Objects that come at once make a better tree than one by one.
    void registerObjects(const std::vector<Object *> &objects) override {
        if (tree_.size() == 0) {
            tree_.build(objects);
        } else {
            BroadPhaseCollisionManager<S>::registerObjects(objects);
        }
    }

    void registerObject(Object *object) override { tree_.insert(object); }
    void unregisterObject(Object *object) override { tree_.remove(object); }
    void setup() override { tree_.refresh(); }
    void update() override { tree_.refresh(); }
    void update(Object *object) override { tree_.move(object); }
    void update(const std::vector<Object *> &objects) override {
        for (Object *object : objects) {
            tree_.move(object);
        }
    }
    void clear() override { tree_.clear(); }
    void getObjects(std::vector<Object *> &objects) const override { objects = tree_.objects(); }
    bool empty() const override { return tree_.size() == 0; }
    std::size_t size() const override { return tree_.size(); }

    void collide(Object *object, void *cdata, CollisionCallBack<S> callback) const override {
        const Tree other = tree_of(object);
        search_meeting(tree_, other, cdata, callback);
    }

    void collide(void *cdata, CollisionCallBack<S> callback) const override { search_meeting(tree_, tree_, cdata, callback); }

    void collide(BroadPhaseCollisionManager<S> *other, void *cdata, CollisionCallBack<S> callback) const override {
        search_meeting(tree_, static_cast<DynamicAABBTreeCollisionManager *>(other)->tree_, cdata, callback);
    }

    void distance(Object *object, void *cdata, DistanceCallBack<S> callback) const override {
        const Tree other = tree_of(object);
        search_nearest(tree_, other, cdata, callback);
    }

    void distance(void *cdata, DistanceCallBack<S> callback) const override { search_nearest(tree_, tree_, cdata, callback); }

    void distance(BroadPhaseCollisionManager<S> *other, void *cdata, DistanceCallBack<S> callback) const override {
        search_nearest(tree_, static_cast<DynamicAABBTreeCollisionManager *>(other)->tree_, cdata, callback);
    }

private:
    using Tree = detail::ObjectTree<S>;

    /// A node of each tree. Of a tree with itself, a node twice stands for the pairs within it.
    struct NodePair {
        S bound;
        int a, b;

        /// For a queue with the nearest on top.
        bool operator<(const NodePair &other) const { return bound > other.bound; }
    };

    static Tree tree_of(Object *object) {
        Tree tree;
        tree.insert(object);
        return tree;
    }

    /// Calls `offer` with the pairs below one that is not two leaves.
    template <typename Offer> static void descend(const Tree &ta, const Tree &tb, const NodePair &pair, const Offer &offer) {
        const auto &a = ta.node(pair.a);
        const auto &b = tb.node(pair.b);
        if (&ta == &tb && pair.a == pair.b) {
            offer(a.children[0], a.children[0]);
            offer(a.children[1], a.children[1]);
            offer(a.children[0], a.children[1]);
        } else if (b.is_leaf() || (!a.is_leaf() && a.box.size() >= b.box.size())) {
            offer(a.children[0], pair.b);
            offer(a.children[1], pair.b);
        } else {
            offer(pair.a, b.children[0]);
            offer(pair.a, b.children[1]);
        }
    }

    static void search_meeting(const Tree &ta, const Tree &tb, void *cdata, CollisionCallBack<S> callback) {
        std::vector<NodePair> stack;
        const auto offer = [&](int a, int b) {
            const bool within = &ta == &tb && a == b;
            if (within ? !ta.node(a).is_leaf() : ta.node(a).box.overlap(tb.node(b).box)) {
                stack.push_back({0, a, b});
            }
        };
        if (ta.size() > 0 && tb.size() > 0) {
            offer(ta.root(), tb.root());
        }
        while (!stack.empty()) {
            const NodePair pair = stack.back();
            stack.pop_back();
            if (ta.node(pair.a).is_leaf() && tb.node(pair.b).is_leaf()) {
                if (callback(ta.node(pair.a).object, tb.node(pair.b).object, cdata)) {
                    return;
                }
            } else {
                descend(ta, tb, pair, offer);
            }
        }
    }

    static void search_nearest(const Tree &ta, const Tree &tb, void *cdata, DistanceCallBack<S> callback) {
        std::priority_queue<NodePair> queue;
        S least = std::numeric_limits<S>::max();
        const auto offer = [&](int a, int b) {
            const bool within = &ta == &tb && a == b;
            const S bound = within ? 0 : ta.node(a).box.distance(tb.node(b).box);
            if (within ? !ta.node(a).is_leaf() : bound < least) {
                queue.push({bound, a, b});
            }
        };
        if (ta.size() > 0 && tb.size() > 0) {
            offer(ta.root(), tb.root());
        }
        while (!queue.empty() && queue.top().bound < least) {
            const NodePair pair = queue.top();
            queue.pop();
            if (ta.node(pair.a).is_leaf() && tb.node(pair.b).is_leaf()) {
                if (callback(ta.node(pair.a).object, tb.node(pair.b).object, cdata, least)) {
                    return;
                }
            } else {
                descend(ta, tb, pair, offer);
            }
        }
    }

    Tree tree_;
};

using DynamicAABBTreeCollisionManagerf = DynamicAABBTreeCollisionManager<float>;
using DynamicAABBTreeCollisionManagerd = DynamicAABBTreeCollisionManager<double>;

/* FCL's other managers find the same pairs. */
template <typename S> using DynamicAABBTreeCollisionManager_Array = DynamicAABBTreeCollisionManager<S>;
template <typename S> using NaiveCollisionManager = DynamicAABBTreeCollisionManager<S>;
template <typename S> using SaPCollisionManager = DynamicAABBTreeCollisionManager<S>;
template <typename S> using SSaPCollisionManager = DynamicAABBTreeCollisionManager<S>;
template <typename S> using IntervalTreeCollisionManager = DynamicAABBTreeCollisionManager<S>;

using DynamicAABBTreeCollisionManager_Arrayf = DynamicAABBTreeCollisionManager_Array<float>;
using DynamicAABBTreeCollisionManager_Arrayd = DynamicAABBTreeCollisionManager_Array<double>;
using NaiveCollisionManagerf = NaiveCollisionManager<float>;
using NaiveCollisionManagerd = NaiveCollisionManager<double>;
using SaPCollisionManagerf = SaPCollisionManager<float>;
using SaPCollisionManagerd = SaPCollisionManager<double>;
using SSaPCollisionManagerf = SSaPCollisionManager<float>;
using SSaPCollisionManagerd = SSaPCollisionManager<double>;
using IntervalTreeCollisionManagerf = IntervalTreeCollisionManager<float>;
using IntervalTreeCollisionManagerd = IntervalTreeCollisionManager<double>;

/// What DefaultCollisionFunction asks and finds.
template <typename S> struct DefaultCollisionData {
    CollisionRequest<S> request;
    CollisionResult<S> result;
    bool done = false;
};

/// Collects contacts, until there are as many as were asked for and no costs are.
template <typename S> bool DefaultCollisionFunction(CollisionObject<S> *o1, CollisionObject<S> *o2, void *data) {
    assert(data != nullptr);
    auto &asked = *static_cast<DefaultCollisionData<S> *>(data);
    if (!asked.done) {
        collide(o1, o2, asked.request, asked.result);
        asked.done = asked.request.isSatisfied(asked.result);
    }
    return asked.done;
}

template <typename S> struct DefaultDistanceData {
    DistanceRequest<S> request;
    DistanceResult<S> result;
    bool done = false;
};

/// Finds the least distance, until it is 0 or less.
template <typename S> bool DefaultDistanceFunction(CollisionObject<S> *o1, CollisionObject<S> *o2, void *data, S &dist) {
    assert(data != nullptr);
    auto &asked = *static_cast<DefaultDistanceData<S> *>(data);
    if (!asked.done) {
        distance(o1, o2, asked.request, asked.result);
    }
    dist = asked.result.min_distance;
    return asked.done || dist <= 0;
}

template <typename S> struct DefaultContinuousCollisionData {
    ContinuousCollisionRequest<S> request;
    ContinuousCollisionResult<S> result;
    bool done = false;
};

template <typename S>
bool DefaultContinuousCollisionFunction(ContinuousCollisionObject<S> *o1, ContinuousCollisionObject<S> *o2, void *data) {
    assert(data != nullptr);
    auto &asked = *static_cast<DefaultContinuousCollisionData<S> *>(data);
    if (!asked.done) {
        collide(o1, o2, asked.request, asked.result);
    }
    return asked.done;
}

} // namespace cstk_fcl

#endif
