# splatray_commit: the library behind app/library/commit.h. Its source is written at every build.
add_custom_target(splatray_commit_text
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DOUTPUT=${CMAKE_CURRENT_BINARY_DIR}/commit.cpp
          -P ${PROJECT_SOURCE_DIR}/app/library/commit.cmake
  BYPRODUCTS ${CMAKE_CURRENT_BINARY_DIR}/commit.cpp VERBATIM)

add_library(splatray_commit STATIC ${CMAKE_CURRENT_BINARY_DIR}/commit.cpp)
add_dependencies(splatray_commit splatray_commit_text)
target_link_libraries(splatray_commit PUBLIC splatray_headers)
