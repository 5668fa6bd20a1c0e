# SPDX-License-Identifier: MIT
# What cpack makes of a build on Debian: rhw, the program; rhw-view, its window; librhw with its ABI in the name, the shared
# libraries librhw and librhw-shader, which are of one version; librhw-vulkan, the Vulkan driver; and librhw-dev, the static ones with headers, CMake and
# pkg-config packages. rhw-view needs rhw, and librhw-dev the shared libraries, of the same build. script/package builds
# and calls it.
# As Debian's own tools have it: DEBFULLNAME and DEBEMAIL of who builds them.
set(maintainer "the rhw authors <rhw@localhost>")
if(NOT "$ENV{DEBEMAIL}" STREQUAL "")
  set(maintainer "the rhw authors <$ENV{DEBEMAIL}>")
  if(NOT "$ENV{DEBFULLNAME}" STREQUAL "")
    set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
  endif()
endif()
set(RHW_MAINTAINER "${maintainer}" CACHE STRING "Who stands in the Debian packages as their maintainer")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME rhw)
set(CPACK_PACKAGE_CONTACT "${RHW_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "3D rendering on the CPU, exact and the same on every machine")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL development library)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
get_target_property(abi rhw_shared SOVERSION)
set(librhw librhw${abi}) # Debian's way: several of them can be installed beside each other
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${librhw})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
# What cpack would write by itself calls ldconfig from scripts, which Debian gave up for triggers.
file(WRITE ${PROJECT_BINARY_DIR}/package/triggers "activate-noawait ldconfig\n")
file(WRITE ${PROJECT_BINARY_DIR}/package/shlibs "librhw ${abi} ${librhw} (>= ${PROJECT_VERSION})
librhw-shader ${abi} ${librhw} (>= ${PROJECT_VERSION})\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA
  ${PROJECT_BINARY_DIR}/package/triggers ${PROJECT_BINARY_DIR}/package/shlibs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "librhw draws triangles, lines and points with shaders written in C, without a
graphics card, a display or a driver. Coverage is exact, and a scene gives the
same bytes on every machine, whatever the number of threads and the
instruction set.
.
This package has the shared libraries, for programs that are linked with them:
librhw, and librhw-shader, which takes shaders as SPIR-V when a program runs.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME librhw-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${librhw} (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "cmake, pkgconf")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "librhw draws triangles, lines and points with shaders written in C, without a
graphics card, a display or a driver. Coverage is exact, and a scene gives the
same bytes on every machine, whatever the number of threads and the
instruction set.
.
This package has the static libraries, the headers and what CMake and
pkg-config need.")
if(RHW_PROGRAM)
  list(APPEND CPACK_COMPONENTS_ALL program)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME rhw)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
  if(RHW_AVIF_NAME) # opened when there is an AVIF, which dpkg-shlibdeps does not see
    string(REGEX REPLACE "[.]so[.]" "" avif ${RHW_AVIF_NAME})
    set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS ${avif})
  endif()
  set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "rhw draws glTF, OBJ, PLY, STL, FBX and other model files and writes the
picture, or depth, normals, positions, ids and whatever else is known about
every pixel. It makes thumbnails of folders, compares pictures and tells what
is in a model file. It needs no graphics card, no display and no driver.
.
This package has the program.")
endif()
if(TARGET rhw_view)
  list(APPEND CPACK_COMPONENTS_ALL view)
  set(CPACK_DEBIAN_VIEW_PACKAGE_NAME rhw-view)
  set(CPACK_DEBIAN_VIEW_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_VIEW_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_VIEW_PACKAGE_DEPENDS rhw)
  set(CPACK_DEBIAN_VIEW_DESCRIPTION "rhw view shows a model in a window: orbit, pan, zoom, fly, play its animations,
switch to depth, normals, ids and whatever else is known about every pixel, and
click on one to be told how it got its value. Pictures are those that rhw
render writes, byte for byte, and need no graphics card.
.
This package has the window, which needs SDL2 and a display; rhw does not.")
endif()
if(TARGET rhw_vulkan)
  list(APPEND CPACK_COMPONENTS_ALL vulkan)
  set(CPACK_DEBIAN_VULKAN_PACKAGE_NAME librhw-vulkan)
  set(CPACK_DEBIAN_VULKAN_PACKAGE_SECTION libs)
  set(CPACK_DEBIAN_VULKAN_PACKAGE_RECOMMENDS libvulkan1)
  set(CPACK_DEBIAN_VULKAN_DESCRIPTION "rhw draws and computes for programs of Vulkan 1.1 and WebGPU without a graphics
card, a display or another driver, the same bytes on every machine.
.
This package has the driver, and registers it with the Vulkan loader.")
endif()
# What Debian has elsewhere than others do, and what only a Debian package has.
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian_layout.cmake)
set(CPACK_RHW_SOURCE ${PROJECT_SOURCE_DIR})
# Static libraries of Debian that the program has in it, whose notices go with it.
if(TARGET rhw_glslang AND EXISTS /usr/share/doc/glslang-dev/copyright AND EXISTS /usr/share/doc/spirv-tools/copyright)
  set(CPACK_RHW_PARTS "glslang-dev;spirv-tools")
endif()
set(CPACK_RHW_SHLIBS ${PROJECT_BINARY_DIR}/package/shlibs)
set(CPACK_RHW_PACKAGES "library=${librhw};development=librhw-dev;program=rhw;view=rhw-view;vulkan=librhw-vulkan")
include(CPack)
