# The tests labelled memcheck once more, under valgrind: no error, no leak.
find_program(VALGRIND valgrind)
if(NOT VALGRIND)
  message(WARNING "valgrind not found: the memory checks are left out")
  return()
endif()

get_property(names DIRECTORY PROPERTY TESTS)
foreach(name ${names})
  get_test_property(${name} LABELS labels)
  if("${labels}" STREQUAL "memcheck")
    add_test(NAME ${name}_memcheck COMMAND ${VALGRIND} --quiet --leak-check=full
      --errors-for-leak-kinds=definite,possible --error-exitcode=9
      --suppressions=${CMAKE_CURRENT_SOURCE_DIR}/memcheck.supp $<TARGET_FILE:${name}>)
    set_tests_properties(${name}_memcheck PROPERTIES TIMEOUT 900)
    # Both write the same files.
    set_tests_properties(${name} ${name}_memcheck PROPERTIES RESOURCE_LOCK ${name})
  endif()
endforeach()
