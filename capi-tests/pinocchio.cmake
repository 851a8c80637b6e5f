# Cross-check of the kinematics of real robots against Pinocchio, where scripts/fetch_pinocchio.sh has put it.
set(CSTK_PINOCCHIO_DIR "${CMAKE_CURRENT_LIST_DIR}/../build/pinocchio" CACHE PATH
  "Folder with Pinocchio and example-robot-data, see scripts/fetch_pinocchio.sh")
find_program(PYTHON3 python3)
mark_as_advanced(PYTHON3)
if(NOT PYTHON3 OR NOT EXISTS ${CSTK_PINOCCHIO_DIR}/cmeel.prefix)
  message(WARNING "SKIPPED: no Pinocchio in ${CSTK_PINOCCHIO_DIR}, or no python3; the cross-check against it is left out")
  return()
endif()

set(pinocchio ${PYTHON3} ${CMAKE_CURRENT_LIST_DIR}/pinocchio_kinematics.py ${cstk_library} ${CSTK_PINOCCHIO_DIR})
add_test(NAME pinocchio_kinematics COMMAND ${pinocchio})
add_test(NAME pinocchio_geometry COMMAND ${pinocchio} --geometry)
set_tests_properties(pinocchio_kinematics pinocchio_geometry PROPERTIES
  LABELS pinocchio TIMEOUT 300 SKIP_RETURN_CODE 77 ENVIRONMENT PYTHONDONTWRITEBYTECODE=1)

# The same robots with their SRDF files.
add_executable(example_robots example_robots.cpp)
target_compile_options(example_robots PRIVATE ${strict})
target_link_libraries(example_robots PRIVATE cstk::cstk)
add_test(NAME example_robots COMMAND example_robots ${CSTK_PINOCCHIO_DIR}/cmeel.prefix/share)
set_tests_properties(example_robots PROPERTIES LABELS pinocchio TIMEOUT 300 SKIP_RETURN_CODE 77)
