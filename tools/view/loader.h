// SPDX-License-Identifier: MIT
// Reads a model while the window goes on: a thread for each, which can be stopped at any time.
#ifndef VIEW_LOADER_H
#define VIEW_LOADER_H

#include "render_state.h"

struct view_loader;

/// Begins to read `path`, which must outlive the loader, as the job says; `wake` is called by its thread at the end.
/// NULL after a report.
struct view_loader *view_loader_start(const struct cli_render_job *job, const char *path, void (*wake)(void));
bool view_loader_is_done(struct view_loader *loader);
/// Says how far it is, for the eye.
void view_loader_describe(const struct view_loader *loader, char *line, size_t size);
/// Frees a loader that is done. True where there is a model: `*read` has it, its input and a view of it then, for the
/// caller to free by cli_render_forget_model.
bool view_loader_take(struct view_loader *loader, struct render *read);
/// Frees a loader in the middle of its work, or NULL.
void view_loader_stop(struct view_loader *loader);

#endif
