// SPDX-License-Identifier: MIT
// A game's loop: one context for the whole run, while levels come and go, the window changes its size, sparks and
// text are new vertices in every frame and a radar is new texels. A frame is two passes: the world, then what is
// blended over it. Nothing waits and nothing is kept for later frames: a level is destroyed in the middle of the pass
// that draws it. All is drawn in two laps; the second one draws the bytes of the first in no more memory.
#include "game_loop.h"
#include "matrix.h"
#include "picture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LAP = 48, SPARKS = 160, RADAR = 64, GRID = 24, MAX_GLYPHS = 64, SHOWN = 5 };

struct vertex {
    float position[3], uv[2];
    int8_t normal[4];
};

struct spark {
    float center[3], half;
    uint8_t color[4];
};

struct rectangle {
    int16_t window[4], texture[4]; // x, y, width, height
    uint8_t color[4];
};

struct mesh {
    rhw_buffer vertices, indices;
    uint32_t index_count;
};

// What lives as long as a level does.
struct level {
    struct mesh ground;
    rhw_texture texture;
    int crates;
};

struct window {
    rhw_texture picture, depth;
    int width, height;
};

struct game {
    rhw_context *context;
    rhw_pipeline mesh_pipeline, spark_pipeline, hud_pipeline;
    rhw_sampler smooth, exact;
    struct mesh cube;
    struct level level;
    int level_number; // from 0
    rhw_buffer sparks, rectangles;
    rhw_texture font, radar;
    uint8_t radar_texels[RADAR][RADAR][4]; // as written last
    struct window window;
};

static const float sky[4] = {0.25f, 0.45f, 0.75f, 1};
static const float beacon[3] = {0, 3, 0}; // spark 0 stays here, before the sky
static const uint8_t beacon_color[4] = {80, 60, 20, 255};

// Resources -----------------------------------------------------------------------------------------

static rhw_buffer make_buffer(rhw_context *context, const char *label, const void *data, size_t size)
{
    const struct rhw_buffer_def def = {.size = size, .data = data, .label = label};
    rhw_buffer buffer;
    must(rhw_buffer_create(context, &def, &buffer), label);
    return buffer;
}

static rhw_texture make_texture(rhw_context *context, const char *label, enum rhw_format format, int width,
                                int height, int mip_levels)
{
    const struct rhw_texture_def def = {
        .format = format, .width = width, .height = height, .mip_levels = mip_levels, .label = label};
    rhw_texture texture;
    must(rhw_texture_create(context, &def, &texture), label);
    return texture;
}

// A square of GRID × GRID cells, `half` from the middle to its edge, with hills that high.
static struct mesh make_ground(rhw_context *context, float half, float hills)
{
    static struct vertex vertices[(GRID + 1) * (GRID + 1)];
    static uint16_t indices[GRID * GRID * 6];
    uint32_t count = 0;
    for (int i = 0; i < (GRID + 1) * (GRID + 1); i++) {
        const float u = (float)(i % (GRID + 1)) / GRID, v = (float)(i / (GRID + 1)) / GRID;
        const float slope = hills * rhw_cos1(u * 12);
        vertices[i] =
            (struct vertex){.position = {(2 * u - 1) * half, hills * rhw_sin1(u * 12), (2 * v - 1) * half},
                            .uv = {6 * u, 6 * v},
                            .normal = {(int8_t)(-100 * slope), 100, 0, 0}};
    }
    for (int i = 0; i < GRID * GRID; i++) {
        const int a = i / GRID * (GRID + 1) + i % GRID, below = a + GRID + 1;
        const int quad[6] = {a, below, below + 1, a, below + 1, a + 1}; // counter-clockwise from above
        for (int j = 0; j < 6; j++) {
            indices[count++] = (uint16_t)quad[j];
        }
    }
    return (struct mesh){make_buffer(context, "ground vertices", vertices, sizeof vertices),
                         make_buffer(context, "ground indices", indices, sizeof indices), count};
}

// −1..1 each way.
static struct mesh make_cube(rhw_context *context)
{
    static const uint16_t quad[6] = {0, 1, 2, 0, 2, 3};
    struct vertex vertices[24] = {0};
    uint16_t indices[36];
    for (int i = 0; i < 24; i++) {
        const int axis = i / 8, side = i / 4 % 2 ? 1 : -1;
        const float u = i % 4 == 1 || i % 4 == 2 ? 1 : -1, v = i % 4 >= 2 ? 1 : -1;
        vertices[i].normal[axis] = (int8_t)(127 * side);
        vertices[i].position[axis] = (float)side;
        vertices[i].position[(axis + 1) % 3] = u * (float)side;
        vertices[i].position[(axis + 2) % 3] = v;
        vertices[i].uv[0] = 0.5f + 0.5f * u;
        vertices[i].uv[1] = 0.5f - 0.5f * v;
    }
    for (int i = 0; i < 36; i++) {
        indices[i] = (uint16_t)(i / 6 * 4 + quad[i % 6]);
    }
    return (struct mesh){make_buffer(context, "cube vertices", vertices, sizeof vertices),
                         make_buffer(context, "cube indices", indices, sizeof indices), 36};
}

// Tiles of two colours with a darker rim, which is what needs mip levels.
static void load_level(struct game *game, int number)
{
    static const uint8_t colors[2][2][4] = {{{90, 160, 70, 255}, {60, 120, 60, 255}},
                                            {{190, 120, 90, 255}, {150, 80, 70, 255}}};
    static uint8_t texels[128 * 128][4];
    const int size = number ? 128 : 64;
    for (int i = 0; i < size * size; i++) {
        const int x = i % size, y = i / size, tile = size / 4;
        const bool rim = x % tile < 2 || y % tile < 2;
        for (int c = 0; c < 4; c++) {
            const int code = colors[number][(x / tile + y / tile) % 2][c];
            texels[i][c] = (uint8_t)(rim && c < 3 ? code / 3 : code);
        }
    }
    struct level *level = &game->level;
    level->ground = make_ground(game->context, number ? 7 : 5.5f, number ? 0.3f : 0.1f);
    level->texture =
        make_texture(game->context, "level", RHW_FORMAT_RGBA8_SRGB, size, size, RHW_MIP_LEVELS_ALL);
    level->crates = number ? 9 : 5;
    must(rhw_texture_write(game->context, level->texture, 0, texels, 0), "level");
    must(rhw_texture_generate_mips(game->context, level->texture), "mips");
    game->level_number = number;
}

static void unload_level(struct game *game)
{
    rhw_buffer_destroy(game->context, game->level.ground.vertices);
    rhw_buffer_destroy(game->context, game->level.ground.indices);
    rhw_texture_destroy(game->context, game->level.texture);
    game->level = (struct level){0};
}

// Letters of 3 × 5 pixels, rows from the top, 3 bits each; each has a cell of 4 × 6. The first is full.
static const char letters[] = "#0123456789AEFLMRSPKV";
static const uint16_t letter_rows[] = {077777, 075557, 026227, 071747, 071717, 055711, 074717,
                                       074757, 071111, 075757, 075717, 025755, 074647, 074644,
                                       044447, 057755, 065655, 034216, 065644, 055655, 055552};
enum { LETTERS = sizeof letters - 1, FONT_WIDTH = 4 * LETTERS, FONT_HEIGHT = 6 };

static rhw_texture make_font(rhw_context *context)
{
    uint8_t texels[FONT_HEIGHT][FONT_WIDTH][4];
    memset(texels, 255, sizeof texels);
    for (int y = 0; y < FONT_HEIGHT; y++) {
        for (int x = 0; x < FONT_WIDTH; x++) {
            const bool set = x % 4 < 3 && y < 5 && letter_rows[x / 4] >> (14 - 3 * y - x % 4) & 1;
            texels[y][x][3] = set ? 255 : 0;
        }
    }
    const rhw_texture font =
        make_texture(context, "font", RHW_FORMAT_RGBA8_UNORM, FONT_WIDTH, FONT_HEIGHT, 1);
    must(rhw_texture_write(context, font, 0, texels, 0), "font");
    return font;
}

static void make_pipelines(struct game *game)
{
    const struct rhw_pipeline_def mesh = {
        .program = {.vertex = RHW_ISA_TABLE(game_mesh_place),
                    .fragment = RHW_ISA_TABLE(game_mesh_paint),
                    .varyings = {RHW_VARYING(struct surface, normal, RHW_SMOOTH, false),
                                 RHW_VARYING(struct surface, uv, RHW_SMOOTH, true)},
                    .varying_count = 2,
                    .uniform_size = sizeof(struct mesh_uniforms)},
        .attributes = {{RHW_VERTEX_FLOAT3, 0, offsetof(struct vertex, position)},
                       {RHW_VERTEX_SNORM8X3, 0, offsetof(struct vertex, normal)},
                       {RHW_VERTEX_FLOAT2, 0, offsetof(struct vertex, uv)}},
        .attribute_count = 3,
        .buffers = {{.stride = sizeof(struct vertex)}},
        .buffer_count = 1,
        .cull = RHW_CULL_BACK,
        .depth_test = true,
        .targets = {{.format = RHW_FORMAT_RGBA8_SRGB}},
        .target_count = 1,
        .label = "mesh",
    };
    // Sparks add their light to what is there; nothing before them, and they hide nothing.
    const struct rhw_pipeline_def spark = {
        .program = {.vertex = RHW_ISA_TABLE(game_spark_place),
                    .fragment = RHW_ISA_TABLE(game_spark_paint),
                    .varyings = {RHW_VARYING(struct sprite, uv, RHW_SMOOTH, false),
                                 RHW_VARYING(struct sprite, color, RHW_FLAT, false)},
                    .varying_count = 2,
                    .uniform_size = sizeof(struct spark_uniforms)},
        .attributes = {{RHW_VERTEX_FLOAT4, 0, offsetof(struct spark, center)},
                       {RHW_VERTEX_UNORM8X4, 0, offsetof(struct spark, color)}},
        .attribute_count = 2,
        .buffers = {{.per_instance = true}},
        .buffer_count = 1,
        .topology = RHW_TRIANGLE_STRIP,
        .depth_test = true,
        .depth_read_only = true,
        .targets = {{.format = RHW_FORMAT_RGBA8_SRGB,
                     .blend = true,
                     .color = {RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD},
                     .alpha = {RHW_BLEND_ZERO, RHW_BLEND_ONE, RHW_BLEND_ADD}}},
        .target_count = 1,
        .label = "spark",
    };
    struct rhw_pipeline_def hud = spark;
    hud.program = (struct rhw_program){.vertex = RHW_ISA_TABLE(game_hud_place),
                                       .fragment = RHW_ISA_TABLE(game_hud_paint),
                                       .varyings = {RHW_VARYING(struct sprite, uv, RHW_NOPERSPECTIVE, false),
                                                    RHW_VARYING(struct sprite, color, RHW_FLAT, false)},
                                       .varying_count = 2,
                                       .uniform_size = sizeof(struct hud_uniforms)};
    hud.attributes[0] = (struct rhw_attribute){RHW_VERTEX_SSCALED16X4, 0, offsetof(struct rectangle, window)};
    hud.attributes[1] =
        (struct rhw_attribute){RHW_VERTEX_SSCALED16X4, 0, offsetof(struct rectangle, texture)};
    hud.attributes[2] = (struct rhw_attribute){RHW_VERTEX_UNORM8X4, 0, offsetof(struct rectangle, color)};
    hud.attribute_count = 3;
    hud.depth_test = hud.depth_read_only = false;
    hud.targets[0].color.src = RHW_BLEND_SRC_ALPHA;
    hud.targets[0].color.dst = RHW_BLEND_ONE_MINUS_SRC_ALPHA;
    hud.label = "hud";
    must(rhw_pipeline_create(game->context, &mesh, &game->mesh_pipeline), mesh.label);
    must(rhw_pipeline_create(game->context, &spark, &game->spark_pipeline), spark.label);
    must(rhw_pipeline_create(game->context, &hud, &game->hud_pipeline), hud.label);
}

static void start(struct game *game)
{
    game->context = picture_context();
    const struct rhw_sampler_def exact = {.min_filter = RHW_FILTER_NEAREST,
                                          .mag_filter = RHW_FILTER_NEAREST,
                                          .mip_filter = RHW_MIP_FILTER_NONE};
    must(rhw_sampler_create(game->context, &(struct rhw_sampler_def){0}, &game->smooth), "sampler");
    must(rhw_sampler_create(game->context, &exact, &game->exact), "sampler");
    make_pipelines(game);
    game->cube = make_cube(game->context);
    game->font = make_font(game->context);
    game->radar = make_texture(game->context, "radar", RHW_FORMAT_RGBA8_SRGB, RADAR, RADAR, 1);
    game->sparks = make_buffer(game->context, "sparks", NULL, SPARKS * sizeof(struct spark));
    game->rectangles = make_buffer(game->context, "hud", NULL, (MAX_GLYPHS + 2) * sizeof(struct rectangle));
    load_level(game, 0);
}

// Frames --------------------------------------------------------------------------------------------

// The window of a frame; 0 × 0 while it is minimized.
static void window_size(int frame, int size[2])
{
    static const int changes[][3] = {
        {0, 320, 200}, {14, 480, 270}, {26, 0, 0}, {29, 240, 320}, {40, 320, 200}};
    for (size_t i = 0; i < sizeof changes / sizeof changes[0] && changes[i][0] <= frame; i++) {
        size[0] = changes[i][1];
        size[1] = changes[i][2];
    }
}

static void fit_window(struct game *game, const int size[2])
{
    struct window *window = &game->window;
    if (size[0] != window->width || size[1] != window->height) {
        const struct window old = *window;
        window->width = size[0];
        window->height = size[1];
        window->picture = make_texture(game->context, "picture", RHW_FORMAT_RGBA8_SRGB, size[0], size[1], 1);
        window->depth = make_texture(game->context, "depth", RHW_FORMAT_D32_FLOAT, size[0], size[1], 1);
        rhw_texture_destroy(game->context, old.picture); // null at first
        rhw_texture_destroy(game->context, old.depth);
    }
}

struct camera {
    float clip[16], view[16];
};

static struct camera make_camera(const struct window *window, int frame)
{
    static const float up[3] = {0, 1, 0}, target[3] = {0, 1.5f, 0};
    const float angle = 0.04f * (float)frame;
    const float eye[3] = {8 * rhw_cos1(angle), 3.5f, 8 * rhw_sin1(angle)};
    struct camera camera;
    float projection[16];
    matrix_look_at(eye, target, up, camera.view);
    matrix_perspective(0.9f, (float)window->width / (float)window->height, 0.5f, 40, projection);
    matrix_mul(projection, camera.view, camera.clip);
    return camera;
}

static void draw_mesh(const struct game *game, rhw_pass pass, const struct mesh *mesh,
                      const struct mesh_uniforms *uniforms)
{
    rhw_pass_set_uniforms(game->context, pass, uniforms, sizeof *uniforms);
    rhw_pass_set_vertex_buffer(game->context, pass, 0, mesh->vertices, 0);
    rhw_pass_set_index_buffer(game->context, pass, mesh->indices, RHW_INDEX_UINT16, 0);
    rhw_pass_draw_indexed(game->context, pass, 0, mesh->index_count, 0, 0, 1);
}

// The ground and the crates around the fountain, each with a matrix and a colour of its own. `leave`: the level ends
// with this frame, and what was drawn of it may go at once.
static uint64_t draw_world(struct game *game, const struct camera *camera, int frame, bool leave)
{
    struct rhw_pass_def def = {
        .colors = {{.texture = game->window.picture}},
        .color_count = 1,
        .depth = {.enabled = true, .texture = game->window.depth},
        .label = "world",
    };
    memcpy(def.colors[0].clear, sky, sizeof sky);
    struct mesh_uniforms uniforms = {.model = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                     .tint = {1, 1, 1}};
    memcpy(uniforms.clip, camera->clip, sizeof uniforms.clip);
    rhw_normalize3_1((float[]){0.5f, 1, 0.25f}, uniforms.sun);
    rhw_pass pass;
    must(rhw_pass_begin(game->context, &def, &pass), "world");
    rhw_pass_set_pipeline(game->context, pass, game->mesh_pipeline);
    rhw_pass_set_texture(game->context, pass, 0, game->level.texture, game->smooth);
    draw_mesh(game, pass, &game->level.ground, &uniforms);
    for (int i = 0; i < game->level.crates; i++) {
        const float around = 6.2831853f * (float)i / (float)game->level.crates,
                    turn = 0.1f * (float)(frame + i);
        const float half = 0.35f + 0.05f * (float)(i % 4), cosine = half * rhw_cos1(turn),
                    sine = half * rhw_sin1(turn);
        const float model[16] = {cosine,
                                 0,
                                 -sine,
                                 0,
                                 0,
                                 half,
                                 0,
                                 0,
                                 sine,
                                 0,
                                 cosine,
                                 0,
                                 3 * rhw_cos1(around),
                                 half + 0.3f,
                                 3 * rhw_sin1(around),
                                 1};
        memcpy(uniforms.model, model, sizeof model);
        for (int c = 0; c < 3; c++) {
            uniforms.tint[c] = (i >> c) % 2 ? 1.0f : 2.0f;
        }
        draw_mesh(game, pass, &game->cube, &uniforms);
    }
    if (leave) {
        unload_level(game);
        load_level(game, 1 - game->level_number);
    }
    struct rhw_stats stats;
    must(rhw_pass_end(game->context, pass, &stats), "world");
    return stats.memory_peak;
}

// A fountain; where each spark is follows from the frame.
static void stream_sparks(struct game *game, int frame)
{
    static struct spark sparks[SPARKS];
    sparks[0] = (struct spark){.half = 0.12f};
    memcpy(sparks[0].center, beacon, sizeof beacon);
    memcpy(sparks[0].color, beacon_color, sizeof beacon_color);
    for (int i = 1; i < SPARKS; i++) {
        const float time = (float)((frame + 3 * i) % LAP) / LAP, angle = (float)(i * 7919 % 628) * 0.01f;
        const float aside = 2 * time * (0.4f + 0.1f * (float)(i % 7));
        sparks[i] = (struct spark){
            .center = {aside * rhw_cos1(angle), 0.2f + 8 * time * (1 - time), aside * rhw_sin1(angle)},
            .half = 0.05f,
            .color = {200, (uint8_t)(160 - 120 * time), (uint8_t)(60 - 60 * time), 255}};
    }
    must(rhw_buffer_write(game->context, game->sparks, 0, sparks, sizeof sparks), "sparks");
}

// A beam that turns.
static void update_radar(struct game *game, int frame)
{
    const float angle = 0.2618f * (float)frame, x = rhw_cos1(angle), y = rhw_sin1(angle);
    for (int i = 0; i < RADAR * RADAR; i++) {
        const float dx = (float)(i % RADAR) - 31.5f, dy = (float)(i / RADAR) - 31.5f;
        const float along = dx * x + dy * y, across = rhw_abs1(dx * y - dy * x), square = dx * dx + dy * dy;
        const bool beam = along > 0 && across<0.2f * along, ring = square> 900 && square < 1000;
        const uint8_t green = (uint8_t)(ring ? 220 : square > 1000 ? 40 : beam ? 80 + 4 * along : 60);
        const uint8_t texel[4] = {ring ? 160 : 10, green, 40, 255};
        memcpy(game->radar_texels[i / RADAR][i % RADAR], texel, sizeof texel);
    }
    must(rhw_texture_write(game->context, game->radar, 0, game->radar_texels, 0), "radar");
}

// Rectangle 0 is the radar, 1 the panel behind the text, then a rectangle for each letter; returns how many.
static uint32_t stream_hud(struct game *game, int frame)
{
    static struct rectangle rectangles[MAX_GLYPHS + 2];
    const int16_t corner = (int16_t)(game->window.width - RADAR - 4);
    rectangles[0] = (struct rectangle){{corner, 4, RADAR, RADAR}, {0, 0, RADAR, RADAR}, {255, 255, 255, 255}};
    rectangles[1] = (struct rectangle){{4, 4, 80, 28}, {1, 1, 1, 1}, {0, 0, 0, 128}};
    uint32_t count = 2;
    char text[MAX_GLYPHS + 1];
    snprintf(text, sizeof text, "FRAME %02d\nLEVEL %d", frame, game->level_number + 1);
    int x = 8, y = 8;
    for (const char *at = text; *at; at++, x += 8) {
        const char *const letter = strchr(letters, *at);
        if (letter) {
            rectangles[count++] = (struct rectangle){{(int16_t)x, (int16_t)y, 8, 12},
                                                     {(int16_t)(4 * (letter - letters)), 0, 4, FONT_HEIGHT},
                                                     {255, 255, 255, 255}};
        } else if (*at == '\n') {
            x = 0;
            y += 12;
        }
    }
    must(rhw_buffer_write(game->context, game->rectangles, 0, rectangles, count * sizeof rectangles[0]),
         "hud");
    return count;
}

// Sparks, which the depth of the world hides, and the HUD, which nothing does.
static void draw_overlay(struct game *game, const struct camera *camera, uint32_t rectangles)
{
    const struct rhw_pass_def def = {
        .colors = {{.texture = game->window.picture, .load = RHW_LOAD_LOAD}},
        .color_count = 1,
        .depth = {.enabled = true,
                  .texture = game->window.depth,
                  .load = RHW_LOAD_LOAD,
                  .store = RHW_STORE_DISCARD},
        .label = "overlay",
    };
    struct spark_uniforms spark;
    memcpy(spark.clip, camera->clip, sizeof spark.clip);
    for (int i = 0; i < 3; i++) {
        spark.right[i] = camera->view[4 * i];
        spark.up[i] = camera->view[4 * i + 1];
    }
    struct hud_uniforms hud = {{(float)game->window.width, (float)game->window.height}, {RADAR, RADAR}};
    rhw_pass pass;
    must(rhw_pass_begin(game->context, &def, &pass), "overlay");
    rhw_pass_set_pipeline(game->context, pass, game->spark_pipeline);
    rhw_pass_set_vertex_buffer(game->context, pass, 0, game->sparks, 0);
    rhw_pass_set_uniforms(game->context, pass, &spark, sizeof spark);
    rhw_pass_draw(game->context, pass, 0, 4, 0, SPARKS);

    rhw_pass_set_pipeline(game->context, pass, game->hud_pipeline);
    rhw_pass_set_vertex_buffer(game->context, pass, 0, game->rectangles, 0);
    rhw_pass_set_texture(game->context, pass, 0, game->radar, game->exact);
    rhw_pass_set_uniforms(game->context, pass, &hud, sizeof hud);
    rhw_pass_draw(game->context, pass, 0, 4, 0, 1);
    hud.texture[0] = FONT_WIDTH;
    hud.texture[1] = FONT_HEIGHT;
    rhw_pass_set_texture(game->context, pass, 0, game->font, game->exact);
    rhw_pass_set_uniforms(game->context, pass, &hud, sizeof hud);
    rhw_pass_draw(game->context, pass, 0, 4, 1, rectangles - 1);
    must(rhw_pass_end(game->context, pass, NULL), "overlay");
}

// Checks --------------------------------------------------------------------------------------------

static int failures;

// What was worked out by hand: a sentence that is said where it does not hold.
static void check(bool holds, const char *sentence)
{
    if (!holds) {
        fprintf(stderr, "does not hold: %s\n", sentence);
        failures++;
    }
}

// Whether a code is that of a linear value in sRGB.
static bool encodes(int code, float linear)
{
    const float exact = 255 * (1.055f * rhw_pow1(linear, 1 / 2.4f) - 0.055f);
    return rhw_abs1((float)code - exact) < 1;
}

static void check_frame(const struct game *game, const struct camera *camera, const uint8_t *pixels)
{
    const int width = game->window.width;
    bool same = true;
    for (int y = 0; y < RADAR; y++) {
        same &=
            memcmp(&pixels[4 * ((4 + y) * width + width - RADAR - 4)], game->radar_texels[y], RADAR * 4) == 0;
    }
    check(same, "the radar shows the texels of this frame, pixel by pixel");
    // F of FRAME begins at (8, 8), each of its pixels is 2 × 2; right of its lower bar nothing is set.
    check(pixels[4 * (9 * width + 9)] == 255, "the upper left pixel of the F is white");
    check(encodes(pixels[4 * (17 * width + 12)], sky[0] * 127 / 255),
          "half of the sky is left behind the text");
    float landed[3];
    matrix_land(camera->clip, beacon, width, game->window.height, landed);
    const uint8_t *const pixel = &pixels[4 * ((int)landed[1] * width + (int)landed[0])];
    for (int c = 0; c < 3; c++) {
        check(encodes(pixel[c], sky[c] + (float)beacon_color[c] / 255), "the beacon adds to the sky");
    }
}

int main(void)
{
    static const int shown[SHOWN] = {0, 11, 20, 32, 47};
    static struct game game;
    uint8_t *first_lap[SHOWN] = {0};
    uint64_t peaks[2] = {0};
    start(&game);
    for (int lap = 0; lap < 2; lap++) {
        for (int frame = 0, next = 0; frame < LAP; frame++) {
            int size[2];
            window_size(frame, size);
            if (size[0] == 0) {
                continue; // minimized
            }
            const bool leave = frame % 12 == 11;
            fit_window(&game, size);
            const struct camera camera = make_camera(&game.window, frame);
            stream_sparks(&game, frame);
            update_radar(&game, frame);
            const uint32_t rectangles = stream_hud(&game, frame);
            peaks[lap] = draw_world(&game, &camera, frame, leave);
            draw_overlay(&game, &camera, rectangles);
            if (next == SHOWN || frame != shown[next]) {
                continue;
            }
            const size_t bytes = (size_t)size[0] * (size_t)size[1] * 4;
            uint8_t *const pixels = picture_read(game.context, game.window.picture, 0);
            if (lap == 0) {
                char name[32];
                snprintf(name, sizeof name, "game_loop.%02d", frame);
                picture_write_png(".", name, size[0], size[1], pixels);
                check_frame(&game, &camera, pixels);
                first_lap[next++] = pixels;
            } else {
                check(memcmp(pixels, first_lap[next], bytes) == 0, "the second lap draws the same frames");
                free(pixels);
                free(first_lap[next++]);
            }
        }
    }
    // Threads that take turns another way may need a few pages more; a level that stayed would need 600 KiB.
    check(peaks[1] <= peaks[0] + (512 << 10), "the second lap needs no more memory");
    rhw_context_destroy(game.context);
    return failures != 0;
}
