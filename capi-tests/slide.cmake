# The slider example: it reports by its exit code whether the robot slid along the obstacle and went on. The paths it
# leaves are checked by FCL (fcl.cmake).
set(CSTK_PUMA560_DIR "${CMAKE_CURRENT_LIST_DIR}/../build/puma560" CACHE PATH
  "Folder with the Puma 560's link0.stl to link6.stl, see scripts/fetch_puma560.sh")
set(examples ${CMAKE_CURRENT_LIST_DIR}/../examples-c)
set(models ${CMAKE_CURRENT_LIST_DIR}/../models)
set(paths ${CMAKE_CURRENT_BINARY_DIR}/paths)
file(MAKE_DIRECTORY ${paths})

add_executable(puma_slider ${examples}/puma_slider.c ${examples}/puma_scene.c)
target_compile_options(puma_slider PRIVATE ${strict_c})
target_link_libraries(puma_slider PRIVATE cstk::cstk m)

add_test(NAME slide_appendix COMMAND puma_slider appendix ${models} ${paths})
set_tests_properties(slide_appendix PROPERTIES FIXTURES_SETUP paths)
set(slide_meshes)
if(EXISTS ${CSTK_PUMA560_DIR}/link6.stl)
  set(slide_meshes ${CSTK_PUMA560_DIR})
  add_test(NAME slide_puma560 COMMAND puma_slider puma560 ${CSTK_PUMA560_DIR} ${paths})
  set_tests_properties(slide_puma560 PROPERTIES FIXTURES_SETUP paths)
else()
  message(WARNING "SKIPPED: no Puma 560 meshes in ${CSTK_PUMA560_DIR}; its slide is left out")
endif()
