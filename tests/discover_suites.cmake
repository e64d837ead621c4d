# add_suites(TARGET [FILTER]) makes one test of ctest from each suite of a program of GoogleTest, because a test for each
# case would start the program a thousand times. A failure prints its cases, and a crash the case that ran last.
# FILTER: gtest's filter of the cases, if not all run.
#
# As a script, which runs after the program is linked: writes these tests for PROGRAM into the file TESTS.
if(CMAKE_SCRIPT_MODE_FILE)
  execute_process(COMMAND ${PROGRAM} --gtest_list_tests --gtest_filter=${FILTER} OUTPUT_VARIABLE lines
                  COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "#[^\n]*" "" lines "${lines}")  # values and types of parameters
  string(REPLACE "\n" ";" lines "${lines}")
  set(suites)
  foreach(line IN LISTS lines)
    if(line MATCHES "^([^ ]+)\\. *$")
      set(suite ${CMAKE_MATCH_1})
      list(APPEND suites ${suite})
      set(cases_of_${suite} "")
      set(count_of_${suite} 0)
    elseif(line MATCHES "^  ([^ ]+) *$")
      string(APPEND cases_of_${suite} "${suite}.${CMAKE_MATCH_1}:")
      math(EXPR count_of_${suite} "${count_of_${suite}} + 1")
    endif()
  endforeach()
  set(tests "")
  foreach(suite IN LISTS suites)
    set(cases "${suite}.*")
    if(NOT FILTER STREQUAL "*")
      set(cases ${cases_of_${suite}})
    endif()
    # Suites of many cases begin first, or a long one would run alone in the end.
    string(APPEND tests "add_test([==[${suite}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${cases}]==])\n"
                        "set_tests_properties([==[${suite}]==] PROPERTIES COST ${count_of_${suite}})\n")
  endforeach()
  file(WRITE ${TESTS} "${tests}")
  return()
endif()

set(discover_suites ${CMAKE_CURRENT_LIST_FILE})
function(add_suites target)
  set(filter *)
  if(ARGN)
    set(filter ${ARGN})
  endif()
  set(tests ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  add_custom_command(TARGET ${target} POST_BUILD BYPRODUCTS ${tests} VERBATIM
                     COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${target}> -DTESTS=${tests} -DFILTER=${filter}
                             -P ${discover_suites})
  # A program that is not built counts as a test that cannot be started.
  file(WRITE ${tests}.include "if(EXISTS [==[${tests}]==])\n  include([==[${tests}]==])\nelse()\n"
                              "  add_test(${target} ${target}_is_not_built)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${tests}.include)
endfunction()
