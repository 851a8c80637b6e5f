# Cross-check against FCL 0.7, where that is installed.
find_package(fcl 0.7 CONFIG QUIET)
if(NOT fcl_FOUND)
  message(WARNING "FCL not found: the cross-check against it is left out")
  return()
endif()

foreach(program fcl_pairs fcl_object_pairs fcl_puma fcl_slide fcl_slides)
  add_executable(${program} ${CMAKE_CURRENT_LIST_DIR}/${program}.cpp)
  target_compile_features(${program} PRIVATE cxx_std_17)
  target_compile_options(${program} PRIVATE -O2 -Wall -Wextra)
  # FCL's own headers are not held to our warnings.
  target_include_directories(${program} SYSTEM PRIVATE
    $<TARGET_PROPERTY:fcl,INTERFACE_INCLUDE_DIRECTORIES>)
  target_link_libraries(${program} PRIVATE cstk::cstk fcl)
endforeach()

add_test(NAME fcl_pairs COMMAND fcl_pairs)
add_test(NAME fcl_puma COMMAND fcl_puma ${CSTK_PUMA560_DIR})
add_test(NAME fcl_object_pairs COMMAND fcl_object_pairs)
set_tests_properties(fcl_pairs fcl_object_pairs fcl_puma PROPERTIES LABELS fcl TIMEOUT 900)
set_tests_properties(fcl_puma PROPERTIES SKIP_RETURN_CODE 77)

add_test(NAME fcl_slide COMMAND fcl_slide ${paths} ${models} ${slide_meshes})
set_tests_properties(fcl_slide PROPERTIES LABELS fcl FIXTURES_REQUIRED paths)

add_test(NAME fcl_slides COMMAND fcl_slides 1000)
set_tests_properties(fcl_slides PROPERTIES LABELS fcl TIMEOUT 900)
