// SPDX-License-Identifier: MIT
// A recording is a pass that was recorded once and is run as often as the program likes, as command buffers of Vulkan
// and deferred contexts of Direct3D 11 are. A recorder records passes for a context. It is a context of its own for the
// functions rhw_pass_*, so several threads may record at once, each with a recorder of its own, while another thread
// works with the context.
//
// What a recording copies, and what it reads when it runs:
//
// - The state of each draw is copied, also the uniforms of rhw_pass_set_uniforms and the values of clears.
// - Buffers and textures are named. Each run reads and writes what they hold then: vertices, indices, storage, texels
//   and the attachments, which each run loads or clears anew. A program that writes them between two runs, by
//   rhw_buffer_write or rhw_buffer_map for example, changes the picture of the next.
// - Memory of the program (rhw_pass_set_vertex_memory and its like) is read by each run. It must stay as long as the
//   recording may run.
// - Commands and counts of indirect draws are read when they are recorded. So are the indices of strips and fans with
//   primitive restart, of programs with vertex_effects, and of stippled strips of lines; in these draws the indices
//   stay as they were. `written` of transform feedback is the same for all runs.
//
// A recording does not keep alive what it uses. Each run looks at all of it first: it is misuse to run a recording that
// uses a thing that was destroyed, or bytes that are mapped. The functions that write buffers and textures between the
// draws of a pass that reads them may give these other memory (rhw_buffer_write); it is misuse to run a recording that
// was made before.
#ifndef RHW_RECORDING_H
#define RHW_RECORDING_H

#include "stats.h"
#include "types.h"

typedef struct rhw_recording rhw_recording;

struct rhw_recording_def {
    const char *label; ///< name in messages; NULL takes that of the pass
    /// Keep the triangles from one run to the next, and do not call vertex functions again as long as nothing was
    /// written to the buffers that the pass reads. This takes memory. The program says by it that the vertex functions
    /// see nothing else that changes, or calls rhw_recording_changed: memory of the program, also under buffers, what
    /// program.user points to, what bindings (bind.h) lead to, buffers in slots that are not read-only, and texels that
    /// vertex functions read. Triangles are made by each run in a context that
    /// validates, in a pass that does not fit the bins at once (bin_memory), and where vertex functions have effects or
    /// are captured.
    bool keeps_triangles;
};

/// Create a recorder of a context. It takes rhw_pass_begin, all functions that set the state of a pass or draw,
/// rhw_pass_keep, rhw_pass_cancel and rhw_context_destroy; all other functions take the context. Ids of the context's
/// things are valid in the recorder, and its hooks are called by the thread that records. One thread at a time may use
/// a recorder, beside another one that uses the context. Things that a recorder uses must not be destroyed, written,
/// mapped or unmapped by another thread while it records. A recorder is destroyed by rhw_context_destroy, before its
/// context.
RHW_API enum rhw_result rhw_recorder_create(rhw_context *context, rhw_context **recorder);

/// End a pass of a recorder, and keep it as a recording, which the caller destroys. `def` may be NULL. On failure
/// `*recording` is NULL: RHW_ERROR_MISUSE says that misuse was reported since the pass began. A pass of a recorder that
/// cannot be kept has ended all the same. A pass of another context goes on, as does one of a recorder that is given to
/// rhw_pass_end.
RHW_API enum rhw_result rhw_pass_keep(rhw_context *recorder, rhw_pass pass,
                                      const struct rhw_recording_def *def, rhw_recording **recording);

/// Run a recording in the context that its recorder was created for, as rhw_pass_end runs a pass, with the same
/// results. Recordings run one after the other, in the order of the calls. Queries have the answer of the last run. It
/// is misuse while a pass of the context is recorded. If the call is misuse, nothing is drawn. `stats` may be NULL.
RHW_API enum rhw_result rhw_recording_run(rhw_context *context, rhw_recording *recording,
                                          struct rhw_stats *stats);

/// Tell that something has changed that the vertex functions of a recording see: the next run makes its triangles anew.
/// It is for recordings with keeps_triangles. The thread that runs the recording calls this.
RHW_API void rhw_recording_changed(rhw_recording *recording);

/// Destroy a recording. `recording` may be NULL. Any thread may call this, also when the context was destroyed.
RHW_API void rhw_recording_destroy(rhw_recording *recording);

#endif
