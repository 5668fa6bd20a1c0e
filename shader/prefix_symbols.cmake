# SPDX-License-Identifier: MIT
# cmake -DNM=nm -DOBJCOPY=objcopy -DLIBRARY=FILE -P prefix_symbols.cmake
# Functions inside librhw-shader begin with shader_, which functions of a program that links the archive may do as well. In
# the archive they get the prefix rhw_ for that reason. A shared library does not show them.
execute_process(COMMAND ${NM} --extern-only --defined-only ${LIBRARY} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL " shader_[A-Za-z0-9_]+" names "${symbols}")
list(REMOVE_DUPLICATES names)
set(pairs "")
foreach(name IN LISTS names)
  string(STRIP ${name} name)
  string(REGEX REPLACE "^shader_" rhw_inner_ renamed ${name})
  string(APPEND pairs "${name} ${renamed}\n")
endforeach()
file(WRITE ${LIBRARY}.symbols "${pairs}")
execute_process(COMMAND ${OBJCOPY} --redefine-syms=${LIBRARY}.symbols ${LIBRARY} COMMAND_ERROR_IS_FATAL ANY)
