// The tests of the C++ layer: those that main() runs, and those that another of them runs with what it has made.
#ifndef CSTK_TESTS_CPP_LAYER_SUBJECTS_HPP
#define CSTK_TESTS_CPP_LAYER_SUBJECTS_HPP

#include <cstk.hpp>

#include <vector>

void poses();
void euler_angles();
void bodies();
void hierarchies();
void robots();
void urdf();
void srdf();
void spaces();
void scenes();
void octrees();
void sets();
void steps();
void queries();

/* At the space of make_space(). */
void predicates(const cstk::Space &space);
void worlds(const cstk::Space &space, const cstk::Body &body);

/* At the scene of queries(). */
void pairs(cstk::Query &query, const cstk::Body &body);
void object_pairs(cstk::Query &query, const cstk::Body &body);
void motions(cstk::Query &query, const cstk::CObject &obstacles, const cstk::Body &body,
             const std::vector<double> &q);
void certificates(cstk::Query &query, const cstk::CObject &obstacles, const std::vector<double> &q);
void paths(cstk::Query &query, const cstk::CObject &obstacles, const std::vector<double> &q);
void regions(cstk::Query &query, const cstk::CObject &obstacles, const std::vector<double> &q);
void slides(cstk::Query &query, const cstk::CObject &obstacles, const std::vector<double> &q);
void batches(cstk::Query &query, const cstk::CObject &obstacles, const cstk::Body &body,
             const std::vector<double> &q);
void maps(cstk::Query &query, const cstk::CObject &obstacles, const std::vector<double> &q);

#endif
