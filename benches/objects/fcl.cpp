#include "fcl.hpp"

#include "fcl_managed.hpp"

#include <string>

namespace {

using Poses = std::shared_ptr<const std::vector<std::vector<Transform>>>;

// Of all links at each station, or of all objects that each step moves.
template <class Item, class Of> Poses transforms_of(const std::vector<Item> &items, Of of) {
    std::vector<std::vector<Transform>> made;
    for (const Item &item : items) {
        made.push_back(transforms(of(item)));
    }
    return std::make_shared<const std::vector<std::vector<Transform>>>(std::move(made));
}

Poses transforms_of(const std::vector<Station> &at) {
    return transforms_of(at, [](const Station &station) { return station.links; });
}

const Way ways[] = {{false, false}, {false, true}, {true, false}, {true, true}};

// The ways to ask one kind of volumes.
template <class BV> class Kind {
  public:
    Kind(const Arm &arm, const Scene &scene, bool box_shapes, const std::string &name)
        : managed_(arm, scene, box_shapes), name_(name) {}

    void classify(const Poses &at, std::vector<Asked> &to) {
        const auto found = std::make_shared<bool>();
        for (const Way way : ways) {
            to.push_back({"FCL", says(way), [this] { managed_.forget(); },
                          [=](std::size_t query) { *found = managed_.meets((*at)[query], way); },
                          [found] { return *found ? 1.0 : 0.0; }});
        }
    }

    void distance(const Poses &at, std::vector<Asked> &to) {
        const auto found = std::make_shared<double>();
        for (const Way way : ways) {
            to.push_back({"FCL", says(way), [this] { managed_.forget(); },
                          [=](std::size_t query) { *found = managed_.distance((*at)[query], way); },
                          [found] { return *found; }});
        }
    }

    void witnesses(const Poses &at, double epsilon, std::vector<Asked> &to) {
        for (const bool together : {false, true}) {
            to.push_back(
                {"FCL", says({together, false}), [] {},
                 [=](std::size_t query) { managed_.list_pairs((*at)[query], epsilon, together); },
                 [this] { return as_number(managed_.listed_pairs()); }});
        }
    }

    void near_objects(const Poses &at, double epsilon, std::vector<Asked> &to) {
        const auto found = std::make_shared<std::uint64_t>();
        for (const bool together : {false, true}) {
            for (const bool contacts_first : {false, true}) {
                const auto ask = [=](std::size_t query) {
                    *found = managed_.list_nearest((*at)[query], epsilon, together, contacts_first);
                };
                to.push_back({"FCL",
                              says({together, false}) + (contacts_first ? " contacts first" : ""),
                              [] {}, ask, [found] { return as_number(*found); }});
            }
        }
    }

    void after_moves(const Poses &at, const std::vector<Step> &steps, const Step &home,
                     Timed timed, std::vector<Asked> &to) {
        const auto found = std::make_shared<bool>();
        const Poses targets = transforms_of(steps, [](const Step &step) { return step.to; });
        const auto back = std::make_shared<std::vector<Transform>>(transforms(home.to));
        const auto begin = [=, &home] {
            managed_.forget();
            managed_.move(home.moved, *back, Update::listed);
        };
        for (const Update update : {Update::listed, Update::all}) {
            for (const Way way : ways) {
                const auto change = [=, &steps](std::size_t query) {
                    managed_.move(steps[query].moved, (*targets)[query], update);
                };
                const auto classify = [=](std::size_t query) {
                    *found = managed_.meets((*at)[query], way);
                };
                to.push_back(timed_after("FCL", says(way) + (update == Update::all ? " refit" : ""),
                                         begin, change, classify,
                                         [found] { return *found ? 1.0 : 0.0; }, timed));
            }
        }
    }

  private:
    std::string says(Way way) const {
        return name_ + (way.together ? " links together" : " each link") +
               (way.last_first ? " last first" : "");
    }

    Managed<BV> managed_;
    std::string name_;
};

} // namespace

struct Fcl::Managers {
    Managers(const Arm &arm, const Scene &scene)
        : obb(arm, scene, false, "OBB"), rss(arm, scene, false, "RSS"),
          obbrss(arm, scene, false, "OBBRSS"), obb_box(arm, scene, true, "OBB and Box"),
          rss_box(arm, scene, true, "RSS and Box") {}

    Kind<fcl::OBB<double>> obb;
    Kind<fcl::RSS<double>> rss;
    Kind<fcl::OBBRSS<double>> obbrss;
    Kind<fcl::OBB<double>> obb_box;
    Kind<fcl::RSS<double>> rss_box;
};

Fcl::Fcl(const Arm &arm, const Scene &scene) : managers_(std::make_unique<Managers>(arm, scene)) {}
Fcl::~Fcl() = default;

std::vector<Asked> Fcl::classify(const std::vector<Station> &at) {
    const Poses poses = transforms_of(at);
    std::vector<Asked> made;
    managers_->obb.classify(poses, made);
    managers_->obbrss.classify(poses, made);
    managers_->obb_box.classify(poses, made);
    return made;
}

std::vector<Asked> Fcl::distance(const std::vector<Station> &at) {
    const Poses poses = transforms_of(at);
    std::vector<Asked> made;
    managers_->rss.distance(poses, made);
    managers_->obbrss.distance(poses, made);
    managers_->rss_box.distance(poses, made);
    return made;
}

std::vector<Asked> Fcl::witnesses(const std::vector<Station> &at, double epsilon) {
    std::vector<Asked> made;
    managers_->rss.witnesses(transforms_of(at), epsilon, made);
    return made;
}

std::vector<Asked> Fcl::near_objects(const std::vector<Station> &at, double epsilon) {
    std::vector<Asked> made;
    managers_->obbrss.near_objects(transforms_of(at), epsilon, made);
    return made;
}

std::vector<Asked> Fcl::after_moves(const std::vector<Station> &at, const std::vector<Step> &steps,
                                    const Step &home, Timed timed) {
    const Poses poses = transforms_of(at);
    std::vector<Asked> made;
    managers_->obb.after_moves(poses, steps, home, timed, made);
    managers_->obb_box.after_moves(poses, steps, home, timed, made);
    return made;
}
