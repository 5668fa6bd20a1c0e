// SPDX-License-Identifier: MIT
// A recorder is a context that records passes for another one, its owner. Recording writes nothing that the owner or
// another recorder looks at, so each may have a thread of its own.
#ifndef RHW_RECORDER_H
#define RHW_RECORDER_H

struct rhw_context;

// Release a recorder that nobody is in and that records no pass.
void rhw_recorder_destroy(struct rhw_context *recorder);

#endif
