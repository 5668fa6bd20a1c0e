// SPDX-License-Identifier: MIT
// Work per triangle must not grow with their number, nor memory: draws instances of a bumpy sphere of a million
// triangles, up to a hundred million of them, and prints what a million takes.
//   growth             the table of docs/performance.md; the last rows take 3 GB
//   growth 16384       those of its rows with targets of that width
//   growth quick       a test: four million triangles against one, in the memory of one
#include <rhw/rhw.h>
#include <rhw/shader.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 1000, ROWS = 500, MESH_TRIANGLES = 2 * COLUMNS * ROWS }; // quads around and along the sphere

struct row {
    int width, height;
    uint32_t instances;
    size_t bin_memory; // 0: the default
};

struct uniforms {
    uint32_t side; // the spheres stand in a grid of side × side
    float aspect;
};

// The position in the grid's cell, and a colour from the place on the sphere.
static void vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct uniforms *const u = groups[g].uniforms;
        const rhw_float *const p = groups[g].attribute[0];
        const float side = (float)u->side;
        rhw_float column, line;
        for (int lane = 0; lane < 8; lane++) {
            column[lane] = (float)((uint32_t)groups[g].instance_index[lane] % u->side);
            line[lane] = (float)((uint32_t)groups[g].instance_index[lane] / u->side);
        }
        const rhw_float scale = rhw_splat(0.9f / side);
        groups[g].position[0] = ((column * 2.0f + 1.0f) / side - 1.0f) + p[0] * scale / u->aspect;
        groups[g].position[1] = ((line * 2.0f + 1.0f) / side - 1.0f) + p[1] * scale;
        groups[g].position[2] = 0.5f - 0.4f * p[2];
        groups[g].position[3] = rhw_splat(1);
        for (int i = 0; i < 3; i++) {
            groups[g].varying[i] = p[i] * 0.5f + 0.5f;
        }
    }
}

static void fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int i = 0; i < 3; i++) {
            groups[g].color[0][i] = groups[g].varying[i];
        }
        groups[g].color[0][3] = rhw_splat(1);
    }
}

static void fail(const char *what)
{
    fprintf(stderr, "growth: %s\n", what);
    exit(1);
}

static void must(enum rhw_result result)
{
    if (result != RHW_OK) {
        fail(rhw_result_string(result));
    }
}

static rhw_buffer make_buffer(rhw_context *context, const void *data, size_t size)
{
    struct rhw_buffer_def def = rhw_buffer_def_default();
    def.size = size;
    def.data = data;
    rhw_buffer buffer;
    must(rhw_buffer_create(context, &def, &buffer));
    return buffer;
}

// Rows from pole to pole; the library's own maths, so that the mesh has the same bytes everywhere.
static void fill_vertices(float (*vertices)[3])
{
    for (int row = 0; row <= ROWS; row++) {
        for (int column = 0; column <= COLUMNS; column++) {
            const rhw_float turn = rhw_splat(6.28318531f * (float)column / COLUMNS),
                            tilt = rhw_splat(3.14159265f * (float)row / ROWS);
            const float radius = 1 + 0.05f * rhw_sin(tilt * 20.0f)[0] * rhw_sin(turn * 20.0f)[0];
            const float around = rhw_sin(tilt)[0] * radius / 1.05f;
            float *const v = vertices[row * (COLUMNS + 1) + column];
            v[0] = around * rhw_cos(turn)[0];
            v[1] = rhw_cos(tilt)[0] * radius / 1.05f;
            v[2] = around * rhw_sin(turn)[0];
        }
    }
}

static void fill_indices(uint32_t *to)
{
    for (uint32_t row = 0; row < ROWS; row++) {
        for (uint32_t column = 0; column < COLUMNS; column++, to += 6) {
            const uint32_t a = row * (COLUMNS + 1) + column, below = a + COLUMNS + 1;
            const uint32_t quad[6] = {a, a + 1, below, a + 1, below + 1, below};
            memcpy(to, quad, sizeof quad);
        }
    }
}

struct mesh {
    rhw_buffer vertices, indices;
};

static struct mesh make_mesh(rhw_context *context)
{
    enum { VERTICES = (COLUMNS + 1) * (ROWS + 1) };
    float(*const vertices)[3] = malloc(VERTICES * sizeof *vertices);
    uint32_t *const indices = malloc((size_t)MESH_TRIANGLES * 3 * sizeof *indices);
    if (!vertices || !indices) {
        fail("out of memory");
    }
    fill_vertices(vertices);
    fill_indices(indices);
    const struct mesh mesh = {make_buffer(context, vertices, VERTICES * sizeof *vertices),
                              make_buffer(context, indices, (size_t)MESH_TRIANGLES * 3 * sizeof *indices)};
    free(vertices);
    free(indices);
    return mesh;
}

static rhw_pipeline make_pipeline(rhw_context *context)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program.vertex[0] = vertex;
    def.program.fragment[0] = fragment;
    def.program.varyings[0] = (struct rhw_varying){.components = 3};
    def.program.varying_count = 1;
    def.program.uniform_size = sizeof(struct uniforms);
    def.attributes[0] = (struct rhw_attribute){.format = RHW_VERTEX_FLOAT3};
    def.attribute_count = 1;
    def.buffers[0].stride = 3 * sizeof(float);
    def.buffer_count = 1;
    def.cull = RHW_CULL_BACK;
    def.depth_test = true;
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline));
    return pipeline;
}

static rhw_texture make_target(rhw_context *context, int width, int height)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.width = width;
    def.height = height;
    rhw_texture target;
    must(rhw_texture_create(context, &def, &target));
    return target;
}

static uint32_t grid_side(uint32_t instances)
{
    uint32_t side = 1;
    while (side * side < instances) {
        side++;
    }
    return side;
}

static struct rhw_stats draw_once(rhw_context *context, const struct row *row, const struct mesh *mesh,
                                  rhw_pipeline pipeline, rhw_texture target)
{
    struct rhw_pass_def def = rhw_pass_def_default();
    def.colors[0].texture = target;
    def.color_count = 1;
    def.depth = (struct rhw_depth_attachment){.enabled = true, .store = RHW_STORE_DISCARD, .clear = 1};
    const struct uniforms uniforms = {grid_side(row->instances), (float)row->width / (float)row->height};
    rhw_pass pass;
    struct rhw_stats stats;
    must(rhw_pass_begin(context, &def, &pass));
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_vertex_buffer(context, pass, 0, mesh->vertices, 0);
    rhw_pass_set_index_buffer(context, pass, mesh->indices, RHW_INDEX_UINT32, 0);
    rhw_pass_set_uniforms(context, pass, &uniforms, sizeof uniforms);
    rhw_pass_draw_indexed(context, pass, 0, 3 * MESH_TRIANGLES, 0, 0, row->instances);
    must(rhw_pass_end(context, pass, &stats));
    return stats;
}

static double time_of(const struct rhw_stats *stats)
{
    return stats->front_ms + stats->back_ms;
}

// The fastest of `frames` frames after one that does not count: memory is touched in it for the first time.
static struct rhw_stats draw_row(const struct row *row, int frames)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.bin_memory = row->bin_memory;
    rhw_context *context;
    must(rhw_context_create(&def, &context));
    const struct mesh mesh = make_mesh(context);
    const rhw_pipeline pipeline = make_pipeline(context);
    const rhw_texture target = make_target(context, row->width, row->height);
    struct rhw_stats best = draw_once(context, row, &mesh, pipeline, target);
    for (int i = 0; i < frames; i++) {
        const struct rhw_stats stats = draw_once(context, row, &mesh, pipeline, target);
        best = i == 0 || time_of(&stats) < time_of(&best) ? stats : best;
    }
    rhw_context_destroy(context);
    const uint64_t expected = (uint64_t)MESH_TRIANGLES * row->instances;
    if (best.triangles_in != expected || best.triangles_culled + best.triangles_rasterized != expected) {
        fail("triangles were lost");
    }
    return best;
}

static void print_row(const struct row *row, const struct rhw_stats *s)
{
    const double millions = (double)s->triangles_in / 1e6, mib = 1 << 20;
    printf("| %.0f M | %d×%d | %.1f | %.2f | %.2f | %.2f | %" PRIu64 " | %.0f | %.0f |\n", millions,
           row->width, row->height, time_of(s), time_of(s) / millions, s->front_ms / millions,
           s->back_ms / millions, s->flushes, (double)s->geometry_peak / mib, (double)s->memory_peak / mib);
    fflush(stdout);
}

// Rows with targets of that width; 0: all.
static int print_table(int width)
{
    static const struct row rows[] = {
        {1920, 1080, 1, 0},   {1920, 1080, 10, 0},   {1920, 1080, 100, 0},
        {16384, 16384, 1, 0}, {16384, 16384, 10, 0}, {16384, 16384, 100, 0},
    };
    puts(
        "| triangles | target | ms | ms per million | front | tiles | flushes | geometry MiB | memory MiB |");
    puts("|---|---|---|---|---|---|---|---|---|");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (width == 0 || rows[i].width == width) {
            const struct rhw_stats stats = draw_row(&rows[i], rows[i].instances > 10 ? 1 : 3);
            print_row(&rows[i], &stats);
        }
    }
    return 0;
}

// Bounds are wide enough for a busy machine: quadratic growth would be 4 times. What is exact is exact.
static int check_growth(void)
{
    enum { LIMIT = 16 << 20 };
    const struct row one = {1280, 720, 1, LIMIT}, four = {1280, 720, 4, LIMIT};
    const struct rhw_stats small = draw_row(&one, 3), large = draw_row(&four, 3);
    print_row(&one, &small);
    print_row(&four, &large);
    if (time_of(&large) > 8 * time_of(&small)) {
        fail("four million triangles took more than eight times what one million takes");
    }
    const uint64_t under_way = (uint64_t)large.threads
                               << 22; // chunks that are under way when the memory is full
    if (large.geometry_peak > LIMIT + LIMIT / 4 + under_way || large.flushes < small.flushes ||
        large.flushes == 0) {
        fail("geometry is not bounded by bin_memory");
    }
    // The memory of a thread that got most of one wave, and then another thread of the next, is kept.
    if (large.memory_peak > small.memory_peak + (uint64_t)large.threads * LIMIT) {
        fail("memory grows with the number of triangles");
    }
    return 0;
}

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "quick") == 0) {
        return check_growth();
    }
    const char *const width = argc == 2 ? argv[1] : "0";
    if (argc > 2 || (argc == 2 && strcmp(width, "1920") != 0 && strcmp(width, "16384") != 0)) {
        fputs("usage: growth [quick | 1920 | 16384]\n", stderr);
        return 2;
    }
    return print_table(atoi(width));
}
