# SPDX-License-Identifier: MIT
# What librhw and librhw-shader have in common. Each is what BUILD_SHARED_LIBS asks for, NAME; NAME_static and NAME_shared
# are it and, with RHW_BOTH_LIBRARIES, the other one. What a library shows of itself is decided where its functions are
# compiled, so the other one has objects of its own.
if(BUILD_SHARED_LIBS)
  set(kind shared)
  set(other static)
else()
  set(kind static)
  set(other shared)
endif()

# Adds the library NAME, whose file is called FILE, and sets NAME_libraries to the targets that it became.
function(rhw_library name file)
  add_library(${name} ${ARGN})
  add_library(rhw::${name} ALIAS ${name})
  add_library(rhw::${name}_${kind} ALIAS ${name})
  set(libraries ${name})
  if(RHW_BOTH_LIBRARIES)
    string(TOUPPER ${other} type)
    add_library(${name}_${other} ${type} ${ARGN})
    add_library(rhw::${name}_${other} ALIAS ${name}_${other})
    list(APPEND libraries ${name}_${other})
  endif()
  foreach(library IN LISTS libraries)
    target_include_directories(${library} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
    get_target_property(type ${library} TYPE)
    if(type STREQUAL "SHARED_LIBRARY")
      target_compile_definitions(${library} PRIVATE RHW_BUILD_SHARED INTERFACE RHW_SHARED)
    endif()
    # Before 1.0 a minor version may change the ABI.
    set_target_properties(${library} PROPERTIES OUTPUT_NAME ${file}
      VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  endforeach()
  set(${name}_libraries ${libraries} PARENT_SCOPE)
endfunction()

# Compiles files of NAME as shaders are, a copy for each instruction set. The other library takes the same objects: they
# take nearly all of the time, and have no function that a library shows.
function(rhw_add_kernels name)
  rhw_add_shaders(${name} ${ARGN})
  if(TARGET ${name}_${other})
    foreach(isa IN LISTS RHW_ISAS)
      target_sources(${name}_${other} PRIVATE $<TARGET_OBJECTS:${name}_${isa}>)
    endforeach()
  endif()
endfunction()

# Installs the libraries of NAME, and for pkg-config a FILE.pc made of FILE.pc.in for what BUILD_SHARED_LIBS asks for, with
# FILE-static.pc and FILE-shared.pc that say which. Of two libraries with one name a linker takes the shared one, so the
# static one is named by its file. The prefix is told from where a .pc stands, so that the installed tree can be moved.
function(rhw_install_library name file)
  include(GNUInstallDirs)
  install(TARGETS ${${name}_libraries} EXPORT rhw
    RUNTIME COMPONENT library
    LIBRARY COMPONENT library NAMELINK_COMPONENT development
    ARCHIVE COMPONENT development)
  file(RELATIVE_PATH pc_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
  set(pc_cflags_static "")
  set(pc_libs_static "\${libdir}/${CMAKE_STATIC_LIBRARY_PREFIX}${file}${CMAKE_STATIC_LIBRARY_SUFFIX} -pthread")
  set(pc_private_static "")
  set(pc_cflags_shared " -DRHW_SHARED")
  set(pc_libs_shared "-L\${libdir} -l${file}")
  set(pc_private_shared "-pthread") # for --static, where the program is linked with -static
  set(pc_files =${kind} -${kind}=${kind})
  if(RHW_BOTH_LIBRARIES)
    list(APPEND pc_files -${other}=${other})
  endif()
  foreach(pc_file IN LISTS pc_files)
    string(REGEX MATCH "^(.*)=(.*)$" pc_file ${pc_file})
    set(pc_suffix ${CMAKE_MATCH_1})
    set(pc_name ${file}${pc_suffix})
    foreach(part cflags libs private)
      set(pc_${part} "${pc_${part}_${CMAKE_MATCH_2}}")
    endforeach()
    configure_file(${file}.pc.in ${pc_name}.pc @ONLY)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${pc_name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
      COMPONENT development)
  endforeach()
endfunction()
