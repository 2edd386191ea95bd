# A floor is one folder of quoll/: its sources become an object library quoll_<folder>, its tests
# (tests/<folder>/*_test.cpp) one test binary <folder>_test that links this floor and those below.

set(quoll_floors "" CACHE INTERNAL "folders in dependency order")
set(quoll_embedded ${CMAKE_CURRENT_BINARY_DIR}/embedded)

# Settings every translation unit of Quoll shares. -ffp-contract=off: same bits with every compiler.
add_library(quoll_options INTERFACE)
target_compile_features(quoll_options INTERFACE cxx_std_20)
target_compile_options(quoll_options INTERFACE -Wall -Wextra -Wshadow -ffp-contract=off
                       -fvisibility=hidden -fvisibility-inlines-hidden)
# GCC 12 warns of what is right, in its own headers (GCC's bugs 105329, 105593, 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(quoll_options INTERFACE -Wno-array-bounds -Wno-maybe-uninitialized
                         -Wno-stringop-overflow -Wno-stringop-overread)
endif()
target_include_directories(quoll_options INTERFACE ${CMAKE_CURRENT_SOURCE_DIR})
if(QUOLL_SANITIZE)
  target_compile_options(quoll_options INTERFACE -fsanitize=${QUOLL_SANITIZE}
                         -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(quoll_options INTERFACE -fsanitize=${QUOLL_SANITIZE})
endif()

# Compressed model files are read where these libraries are.
find_package(ZLIB QUIET)
find_package(LibLZMA QUIET)
add_library(quoll_compression INTERFACE)
if(ZLIB_FOUND)
  target_link_libraries(quoll_compression INTERFACE ZLIB::ZLIB)
  target_compile_definitions(quoll_compression INTERFACE QUOLL_ZLIB)
endif()
if(LIBLZMA_FOUND)
  target_link_libraries(quoll_compression INTERFACE LibLZMA::LibLZMA)
  target_compile_definitions(quoll_compression INTERFACE QUOLL_LZMA)
endif()

function(quoll_floor folder)
  cmake_parse_arguments(arg "NO_EXCEPTIONS" "" "EXCEPT" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/quoll/${folder}/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_library(quoll_${folder} OBJECT ${sources})
  set_target_properties(quoll_${folder} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(quoll_${folder} PRIVATE quoll_options fmt::fmt-header-only)
  if(folder STREQUAL "base")
    target_link_libraries(quoll_base PRIVATE quoll_compression)
  endif()
  target_include_directories(quoll_${folder} PRIVATE ${quoll_embedded})
  if(arg_NO_EXCEPTIONS)
    target_compile_options(quoll_${folder} PRIVATE -fno-exceptions)
    list(TRANSFORM arg_EXCEPT PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/quoll/${folder}/)
    set_source_files_properties(${arg_EXCEPT} PROPERTIES COMPILE_OPTIONS -fexceptions)
  endif()
  set(quoll_floors ${quoll_floors} ${folder} CACHE INTERNAL "")
endfunction()

# quoll_precompile(FLOOR...): cmake/precompiled.hpp is read once, by the first, for all of them: floors with
# the same options.
function(quoll_precompile first)
  target_precompile_headers(quoll_${first} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled.hpp)
  foreach(floor IN LISTS ARGN)
    target_precompile_headers(quoll_${floor} REUSE_FROM quoll_${first})
  endforeach()
endfunction()

# GMP for a floor, if it was found: its sources see QUOLL_GMP, and what is made of the floor links
# quoll_gmp_library.
function(quoll_fractions folder)
  if(quoll_gmp AND TARGET quoll_${folder})
    target_compile_definitions(quoll_${folder} PRIVATE QUOLL_GMP)
    target_include_directories(quoll_${folder} SYSTEM PRIVATE ${GMP_INCLUDE_DIR})
  endif()
endfunction()

# Google Highway for a floor: its headers alone, no library. Its thousand small functions are nothing
# without optimisation, in the trees for sanitizers too.
function(quoll_vectors folder)
  find_path(HWY_INCLUDE_DIR hwy/highway.h REQUIRED)
  mark_as_advanced(HWY_INCLUDE_DIR)
  target_include_directories(quoll_${folder} SYSTEM PRIVATE ${HWY_INCLUDE_DIR})
  set_source_files_properties(${CMAKE_CURRENT_SOURCE_DIR}/quoll/${folder}/arithmetic.cpp
                              PROPERTIES COMPILE_OPTIONS -O2 SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# All floors together: the library users link, Quoll::Quoll.
function(quoll_library)
  add_library(quoll STATIC)
  set_target_properties(quoll PROPERTIES POSITION_INDEPENDENT_CODE ON EXPORT_NAME Quoll)
  foreach(folder IN LISTS quoll_floors)
    target_sources(quoll PRIVATE $<TARGET_OBJECTS:quoll_${folder}>)
  endforeach()
  target_compile_features(quoll PUBLIC cxx_std_20)
  target_include_directories(quoll PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}>
                                          $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(quoll PUBLIC Threads::Threads PRIVATE ${quoll_gmp_library})
  foreach(library ZLIB::ZLIB LibLZMA::LibLZMA)
    if(TARGET ${library})
      target_link_libraries(quoll PRIVATE ${library})
    endif()
  endforeach()
  if(QUOLL_SANITIZE)
    target_link_options(quoll PUBLIC -fsanitize=${QUOLL_SANITIZE})
  endif()
  add_library(Quoll::Quoll ALIAS quoll)
endfunction()

# The files that match the patterns, inside the floor's object library as one generated file
# embedded_worlds.inc: a list of {"name", R"quoll(text)quoll"}, in the order of the names.
function(quoll_embed folder)
  if(NOT TARGET quoll_${folder})
    return()
  endif()
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  file(GLOB files CONFIGURE_DEPENDS ${ARGN})
  set(output ${quoll_embedded}/embedded_worlds.inc)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -D "files=${files}" -D "output=${output}"
            -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/embed.cmake
    DEPENDS ${files} ${CMAKE_CURRENT_SOURCE_DIR}/cmake/embed.cmake VERBATIM
    COMMENT "Embedding the world files")
  target_sources(quoll_${folder} PRIVATE ${output})
endfunction()

# The library, its headers and a package so that find_package(Quoll CONFIG) gives Quoll::Quoll.
function(quoll_install)
  include(CMakePackageConfigHelpers)
  set(package ${CMAKE_INSTALL_LIBDIR}/cmake/Quoll)
  install(TARGETS quoll EXPORT QuollTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  foreach(folder IN LISTS quoll_floors)
    install(DIRECTORY quoll/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/quoll
            FILES_MATCHING PATTERN "*.hpp")
  endforeach()
  file(GLOB together CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/quoll/*.hpp)
  install(FILES ${together} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/quoll)
  install(EXPORT QuollTargets NAMESPACE Quoll:: DESTINATION ${package})
  configure_package_config_file(${CMAKE_CURRENT_SOURCE_DIR}/cmake/QuollConfig.cmake.in
    ${CMAKE_CURRENT_BINARY_DIR}/QuollConfig.cmake INSTALL_DESTINATION ${package})
  write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/QuollConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/QuollConfig.cmake
                ${CMAKE_CURRENT_BINARY_DIR}/QuollConfigVersion.cmake DESTINATION ${package})
endfunction()
