# SPDX-License-Identifier: MIT
# cpack runs this on what is installed for the packages, a folder for each component, before it packs them.
cmake_policy(VERSION 3.22)

# What the libraries of a component need, which cpack finds out of programs alone without scripts that call ldconfig. It
# writes those for what stands in lib or a folder of it. A library may need another of the package itself.
macro(find_needs component pattern)
  file(GLOB_RECURSE libraries ${CPACK_TEMPORARY_DIRECTORY}/${component}/${pattern})
  list(GET libraries 0 folder)
  get_filename_component(folder ${folder} DIRECTORY)
  string(REGEX MATCH "${component}=([^;]*)" own "${CPACK_RHW_PACKAGES}")
  set(own ${CMAKE_MATCH_1})
  file(WRITE ${CPACK_TEMPORARY_DIRECTORY}/needs/debian/control "Source: rhw\n\nPackage: ${own}\nArchitecture: any\n")
  execute_process(COMMAND dpkg-shlibdeps -O -l${folder} -L${CPACK_RHW_SHLIBS} -x${own} ${libraries}
    WORKING_DIRECTORY ${CPACK_TEMPORARY_DIRECTORY}/needs
    OUTPUT_VARIABLE needs OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(TOUPPER ${component} upper)
  string(REPLACE "shlibs:Depends=" "" CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${needs}")
  file(REMOVE_RECURSE ${CPACK_TEMPORARY_DIRECTORY}/needs)
endmacro()

find_needs(library librhw*.so.*.*.*)
if(IS_DIRECTORY ${CPACK_TEMPORARY_DIRECTORY}/vulkan)
  find_needs(vulkan librhw_vulkan.so)
endif()
foreach(pair IN LISTS CPACK_RHW_PACKAGES)
  string(REGEX MATCH "^(.*)=(.*)$" pair "${pair}")
  set(component ${CMAKE_MATCH_1})
  set(package ${CMAKE_MATCH_2})
  set(share ${CPACK_TEMPORARY_DIRECTORY}/${component}${CPACK_PACKAGING_INSTALL_PREFIX}/share)
  if(NOT IS_DIRECTORY ${CPACK_TEMPORARY_DIRECTORY}/${component})
    continue()
  endif()
  if(EXISTS ${share}/zsh/site-functions)
    file(RENAME ${share}/zsh/site-functions ${share}/zsh/vendor-completions)
  endif()
  # What lintian asks of packages that Debian itself distributes, and what it takes for a mistake.
  file(WRITE ${share}/lintian/overrides/${package} "# Nobody has asked for it in Debian's list of bugs.
${package}: initial-upload-closes-no-bugs
")
  if(CPACK_PACKAGE_CONTACT MATCHES "@localhost>$")
    file(APPEND ${share}/lintian/overrides/${package} "# Built without DEBEMAIL, for the machine that builds it.
${package}: bogus-mail-host
${package}: bogus-mail-host-in-debian-changelog
")
  endif()
  if(package STREQUAL librhw-dev)
    file(APPEND ${share}/lintian/overrides/${package} "# Without it gcc warns of every function of the shaders' header, which takes vectors by value.
${package}: pkg-config-bad-directive
")
  endif()
  file(GLOB pages ${share}/man/man*/*.[0-9])
  set(doc ${share}/doc/${package})
  file(MAKE_DIRECTORY ${doc})
  configure_file(${CPACK_RHW_SOURCE}/package/copyright ${doc}/copyright COPYONLY)
  if(package STREQUAL rhw)
    foreach(part IN LISTS CPACK_RHW_PARTS)
      configure_file(/usr/share/doc/${part}/copyright ${doc}/copyright.${part} COPYONLY)
    endforeach()
  endif()
  configure_file(${CPACK_RHW_SOURCE}/CHANGELOG.md ${doc}/changelog COPYONLY)
  file(WRITE ${doc}/changelog.Debian "rhw (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium

  * See changelog.gz.

 -- ${CPACK_PACKAGE_CONTACT}  Mon, 23 Nov 2026 00:00:00 +0000
")
  execute_process(COMMAND gzip -9n ${pages} ${doc}/changelog ${doc}/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)
endforeach()
