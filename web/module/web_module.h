// SPDX-License-Identifier: MIT
// What the WebAssembly module gives to JavaScript, which web/npm/index.js makes an interface of.
//
// An instance of the module has one of two parts. One reads a model file, writes what it read to a file in memory and
// is thrown away, as the process of reader_process.c is natively: what a hostile file does to it ends with it. The
// other takes those bytes and draws; it lives as long as anybody draws. So reading may leave memory behind and leave
// by exit().
//
// Options arrive as the words of rhw render's command line, each with a 0 behind it, and go through the program's own
// parser: the same names, defaults, limits and messages. Functions that can fail begin a new list of messages
// (web_messages), lines as the program writes them to standard error.
#ifndef WEB_MODULE_H
#define WEB_MODULE_H

#include "render_state.h"

/// Lines since the last web_messages_clear, each with a line feed.
const char *web_messages(void);
void web_messages_clear(void);

/// 64-byte aligned, as web_scene_open wants it; NULL: no memory. web_free takes what is from here and what is from
/// malloc.
void *web_allocate(size_t size);
void web_free(void *memory);

/// Fills a job from `size` bytes of words, which must live as long as the job. False after a message.
bool web_job_parse(struct cli_render_job *job, char *words, size_t size);

/// web_read.c: reads the model file that the words name and writes it to WEB_REPLY. Ends the instance by exit: 0, or
/// 3 after a message.
#define WEB_REPLY "/reply"
int web_read(char *words, size_t size);

/// The rows of scene/draw/output_table.h: name, scene_output, enum scene_element and channels, each with a line feed.
const char *web_outputs(void);

// web_scene.c: a model and what is needed to draw it again and again.
struct web_scene;

/// Takes the bytes that web_read wrote, in memory of web_allocate, in any case. `words` are those of that call. NULL
/// after a message.
struct web_scene *web_scene_open(void *bytes, size_t size, char *words, size_t words_size);
void web_scene_close(struct web_scene *scene);
/// From now on a fragment shader, in SPIR-V of `size` bytes, shades what rhw render --fragment-shader would; 0: none does.
/// The words are copied. False after a message, and then none does.
bool web_scene_shade(struct web_scene *scene, const void *words, size_t size);
/// Chooses the view that the words ask for and draws nothing. False after a message.
bool web_scene_look(struct web_scene *scene, char *words, size_t size);
/// Draws it. `outputs`: scene_output. False after a message, or without one when the module's goesOn(), a function of
/// JavaScript that is asked all the while, returned false.
bool web_scene_render(struct web_scene *scene, char *words, size_t size, uint32_t outputs);
/// The picture of one scene_output that was drawn last, or NULL; valid until the scene draws again or is closed.
const void *web_scene_picture(const struct web_scene *scene, uint32_t output);
/// Of the view that was chosen last: width, height; eye, target and up; 1 for an orthographic camera, the vertical
/// angle of view in degrees, half the height of an orthographic picture; near and far plane; what positions count from.
enum { WEB_VIEW_NUMBERS = 19 };
const double *web_scene_view(struct web_scene *scene);
/// That drew last.
int web_scene_threads(const struct web_scene *scene);
/// Prints what rhw explain --json does, a line with a form feed alone, and what it does without. False after a message.
bool web_scene_explain(struct web_scene *scene, char *words, size_t size, int x, int y, int sample);
/// Prints what rhw info --json does.
void web_scene_info(const struct web_scene *scene);

// web_rasterize.c: triangles without a model.

/// What web_rasterize is asked for.
struct web_triangles {
    int width, height;
    const float *positions; ///< [vertex_count][components]
    int32_t components;     ///< 4: X, Y, Z, W; 3: x, y, z, and W is 1
    uint32_t vertex_count;
    const uint32_t *indices; ///< 3 for each triangle; NULL: vertices in their order
    uint32_t index_count;
    const float *matrix; ///< [16], column major, from the positions to clip coordinates; NULL: they are such
    int32_t cull;        ///< enum rhw_cull; front faces are counter-clockwise
    int32_t depth_range; ///< enum rhw_depth_range
    int32_t threads;     ///< at most, 1..RHW_MAX_THREADS; afterwards how many drew
    // What comes out, [height][width] from the top left. NULL: not wanted.
    uint32_t *ids;      ///< 1 + the nearest triangle's number; 0 where there is none
    float *depth;       ///< 0 near to 1 far; 1 where there is none
    float *barycentric; ///< [4]: a, b, c, which are right in perspective, and 0
};
/// False after a message.
bool web_rasterize(struct web_triangles *triangles);

#endif
