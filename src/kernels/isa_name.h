// SPDX-License-Identifier: MIT
// RHW_ISA_NAME(name) is name_avx2 and the like in a file that is compiled once per instruction set.
#ifndef RHW_ISA_NAME_H
#define RHW_ISA_NAME_H

#define RHW_ISA_JOIN2(name, suffix) name##_##suffix
#define RHW_ISA_JOIN(name, suffix)  RHW_ISA_JOIN2(name, suffix)
#define RHW_ISA_NAME(name)          RHW_ISA_JOIN(name, RHW_ISA_SUFFIX)

#endif
