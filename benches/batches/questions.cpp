#include "questions.hpp"

#include <cmath>
#include <stdexcept>

namespace {

template <typename Items> void require_all(const Items &items, std::size_t count) {
    if (items.done.answered != count) {
        throw std::runtime_error(items.first_failure);
    }
}

cstk::Span<double> item(const std::vector<double> &q, std::size_t nq, std::size_t i) { return {q.data() + i * nq, nq}; }

Question classes(const cstk::CObject &contact, std::size_t nq) {
    return {"class", 1,
            [=](cstk::Query &query, const std::vector<double> &q, std::size_t count) {
                Answers answers(count);
                for (std::size_t i = 0; i < count; ++i) {
                    answers[i] = query.classify(contact, item(q, nq, i));
                }
                return answers;
            },
            [=](const cstk::Batch &batch, std::uint32_t threads, const std::vector<double> &q, std::size_t count) {
                const auto found = batch.classify(contact, {q.data(), count * nq}, count, cstk::batch_options(threads));
                require_all(found, count);
                return Answers(found.values.begin(), found.values.end());
            }};
}

Question distances(const cstk::CObject &contact, std::size_t nq) {
    return {"distance", 4,
            [=](cstk::Query &query, const std::vector<double> &q, std::size_t count) {
                Answers answers(count);
                for (std::size_t i = 0; i < count; ++i) {
                    answers[i] = query.distance(contact, item(q, nq, i)).distance;
                }
                return answers;
            },
            [=](const cstk::Batch &batch, std::uint32_t threads, const std::vector<double> &q, std::size_t count) {
                Answers answers(count);
                std::vector<cstk_status> statuses(count);
                cstk_batch_result done;
                const cstk_batch_options options = cstk::batch_options(threads);
                cstk::check(cstk_distance_batch(batch.get(), contact.get(), q.data(), count, nq, INFINITY, &options, nullptr,
                                                nullptr, answers.data(), nullptr, nullptr, 0, statuses.data(), &done));
                return answers;
            }};
}

/// One by one: the distance, then the gradient of what lies no farther.
Question gradients(const cstk::CObject &contact, std::size_t nq, std::size_t nv) {
    return {"distance and gradient", 4,
            [=](cstk::Query &query, const std::vector<double> &q, std::size_t count) {
                Answers answers(count);
                query.set_contacts(CSTK_CONTACTS_NEAREST);
                for (std::size_t i = 0; i < count; ++i) {
                    const cstk_distance_result nearest = query.distance(contact, item(q, nq, i));
                    if (nearest.has_contact) {
                        answers[i] = query.gradients(contact, item(q, nq, i), nearest.upper, 1).gradients[nv - 2];
                    }
                }
                query.set_contacts(CSTK_CONTACTS_ALL);
                return answers;
            },
            [=](const cstk::Batch &batch, std::uint32_t threads, const std::vector<double> &q, std::size_t count) {
                const auto found = batch.distance(contact, {q.data(), count * nq}, count, INFINITY, nv, cstk::batch_options(threads));
                require_all(found, count);
                Answers answers(count);
                for (std::size_t i = 0; i < count; ++i) {
                    answers[i] = found.gradients[i * nv + nv - 2];
                }
                return answers;
            }};
}

/// Any contact will do, as for a planner's edges.
Question motions(const cstk::CObject &contact, std::size_t nq) {
    cstk_motion_options any = cstk::motion_options();
    any.any_contact = 1;
    return {"motion to the next", 40,
            [=](cstk::Query &query, const std::vector<double> &q, std::size_t count) {
                Answers answers(count - 1);
                for (std::size_t i = 0; i + 1 < count; ++i) {
                    const cstk_motion_result found = query.motion(contact, item(q, nq, i), item(q, nq, i + 1), any);
                    answers[i] = found.outcome + found.times[1];
                }
                return answers;
            },
            [=](const cstk::Batch &batch, std::uint32_t threads, const std::vector<double> &q, std::size_t count) {
                const std::size_t numbers = (count - 1) * nq;
                const auto found = batch.motion(contact, {q.data(), numbers}, {q.data() + nq, numbers}, count - 1, any,
                                                cstk::batch_options(threads));
                require_all(found, count - 1);
                Answers answers(count - 1);
                for (std::size_t i = 0; i + 1 < count; ++i) {
                    answers[i] = found.values[i].outcome + found.values[i].times[1];
                }
                return answers;
            }};
}

} // namespace

std::vector<Question> questions(const problems::Workcell &workcell) {
    const std::size_t nq = workcell.space.nq(), nv = workcell.space.nv();
    return {classes(workcell.contact, nq), distances(workcell.contact, nq), gradients(workcell.contact, nq, nv),
            motions(workcell.contact, nq)};
}
