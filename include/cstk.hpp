/* cstk.hpp: a thin C++17 layer over cstk.h: handles that release themselves, statuses as exceptions.
 *
 * Lists are cut at max_count (4096 where it is not given); look at `truncated`.
 *
 * Every class holds one reference; copying shares the object (another reference), as in C, but for Query, which is moved. Functions
 * throw cstk::Error where the C call returns a status other than CSTK_OK. What a call does, its units, frames and thread
 * safety are said in cstk.h at the function of the same name. Answers are the C structures; lists belong to the Query until
 * its next call, and cstk/lists.hpp has views of them. cstk/eigen.hpp, not included here, takes and gives poses of Eigen.
 */
#ifndef CSTK_HPP
#define CSTK_HPP

#if __cplusplus < 201703L && (!defined(_MSVC_LANG) || _MSVC_LANG < 201703L)
#error "cstk.hpp needs C++17: compile with -std=c++17 or later"
#endif

/* Each includes only those above it. */
#include <cstk/error.hpp>
#include <cstk/span.hpp>
#include <cstk/lists.hpp>
#include <cstk/detail.hpp>
#include <cstk/progress.hpp>
#include <cstk/pose.hpp>
#include <cstk/euler.hpp>
#include <cstk/hierarchy.hpp>
#include <cstk/mesh.hpp>
#include <cstk/body.hpp>
#include <cstk/body_builder.hpp>
#include <cstk/robot.hpp>
#include <cstk/robot_builder.hpp>
#include <cstk/space.hpp>
#include <cstk/environment.hpp>
#include <cstk/octree.hpp>
#include <cstk/describe.hpp>
#include <cstk/predicate.hpp>
#include <cstk/cobject.hpp>
#include <cstk/at_configuration.hpp>
#include <cstk/pair.hpp>
#include <cstk/object_pairs.hpp>
#include <cstk/depth.hpp>
#include <cstk/certificate.hpp>
#include <cstk/motion.hpp>
#include <cstk/path.hpp>
#include <cstk/region.hpp>
#include <cstk/slide.hpp>
#include <cstk/query.hpp>
#include <cstk/batch.hpp>
#include <cstk/map.hpp>

#endif
