// SPDX-License-Identifier: MIT
// The three gears of glxgears, at three angles. As in OpenGL 1, light is computed per vertex, quad strips
// are strips of triangles that their last vertices shade, and depth runs from −1 to 1 in clip coordinates.
// Flat and smooth shading are two pipelines that differ in a qualifier. All gears stand in one buffer,
// strips apart by primitive restart.
#include "gears.h"
#include "matrix.h"
#include "outside.h"

enum { SIZE = 300 };

// The uniforms.
struct placed {
    float clip[16], eye[16]; // from coordinates of the gear
    float color[3];
};

// Matrices ------------------------------------------------------------------------------------------

static void identity(float m[16])
{
    for (int i = 0; i < 16; i++) {
        m[i] = i % 5 == 0 ? 1 : 0;
    }
}

// m = m · what glTranslatef, glRotatef about an axis, and glFrustum make.
static void translate(float m[16], float x, float y, float z)
{
    float moved[4];
    rhw_mat4_mul_point1(m, (float[]){x, y, z}, moved);
    memcpy(&m[12], moved, sizeof moved);
}

static void rotate(float m[16], int axis, float degrees)
{
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    float by[16], turned[2], before[16];
    turn((double)degrees, turned);
    identity(by);
    by[5 * a] = by[5 * b] = turned[0];
    by[4 * a + b] = turned[1];
    by[4 * b + a] = -turned[1];
    memcpy(before, m, sizeof before);
    matrix_mul(before, by, m);
}

static void frustum(float half_width, float half_height, float near, float far, float m[16])
{
    memset(m, 0, 16 * sizeof(float));
    m[0] = near / half_width;
    m[5] = near / half_height;
    m[10] = -(far + near) / (far - near);
    m[11] = -1;
    m[14] = -2 * far * near / (far - near);
}

// Where a gear stands, its own turn aside, when the eyes are 40 away.
static void place(const struct gear *gear, float angle, struct placed *placed)
{
    float projection[16];
    frustum(1, 1, 5, 60, projection);
    identity(placed->eye);
    translate(placed->eye, 0, 0, -40);
    rotate(placed->eye, 0, 20);
    rotate(placed->eye, 1, 30);
    translate(placed->eye, gear->at[0], gear->at[1], 0);
    rotate(placed->eye, 2, gear->speed * angle + gear->phase);
    matrix_mul(projection, placed->eye, placed->clip);
    memcpy(placed->color, gear->color, sizeof placed->color);
}

// Drawing -------------------------------------------------------------------------------------------

static void light_vertex(struct rhw_vertex1 *v)
{
    static const float towards[3] = {5, 5, 10};
    const struct placed *placed = v->uniforms;
    float normal[3], sun[3];
    rhw_mat4_mul_point1(placed->clip, v->attribute[0], v->position);
    rhw_mat4_mul_direction1(placed->eye, v->attribute[1], normal);
    rhw_normalize3_1(normal, normal);
    rhw_normalize3_1(towards, sun);
    const float light = 0.2f + rhw_max1(rhw_dot3_1(normal, sun), 0);
    for (int c = 0; c < 3; c++) {
        v->varying[c] = placed->color[c] * light;
    }
}

static void paint(struct rhw_fragment1 *f)
{
    memcpy(f->color[0], f->varying, 3 * sizeof(float));
    f->color[0][3] = 1;
}

static rhw_pipeline make_pipeline(rhw_context *context, enum rhw_qualifier shading)
{
    const struct rhw_pipeline_def def = {
        .program = {.vertex1 = light_vertex,
                    .fragment1 = paint,
                    .varyings = {{.components = 3, .qualifier = shading}},
                    .varying_count = 1,
                    .uniform_size = sizeof(struct placed)},
        .attributes = {{RHW_VERTEX_FLOAT3, 0, offsetof(struct corner, position)},
                       {RHW_VERTEX_FLOAT3, 0, offsetof(struct corner, normal)}},
        .attribute_count = 2,
        .buffers = {{.stride = sizeof(struct corner)}},
        .buffer_count = 1,
        .topology = RHW_TRIANGLE_STRIP,
        .primitive_restart = true,
        .provoking = RHW_PROVOKING_LAST,
        .cull = RHW_CULL_BACK,
        .depth_range = RHW_DEPTH_MINUS_ONE_TO_ONE,
        .depth_test = true,
        .targets = {{.format = RHW_FORMAT_RGBA8_UNORM}},
        .target_count = 1,
        .label = shading == RHW_FLAT ? "flat" : "smooth",
    };
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), def.label);
    return pipeline;
}

struct scene {
    rhw_pipeline flat, smooth;
    rhw_buffer corners, indices;
    rhw_texture picture;
    struct mesh mesh;
};

static void make_scene(rhw_context *context, struct scene *scene)
{
    struct mesh *const mesh = &scene->mesh;
    make_mesh(mesh);
    const struct rhw_buffer_def corner_def = {.size = mesh->corner_count * sizeof mesh->corners[0],
                                              .data = mesh->corners};
    const struct rhw_buffer_def index_def = {.size = mesh->index_count * sizeof mesh->indices[0],
                                             .data = mesh->indices};
    const struct rhw_texture_def def = {.format = RHW_FORMAT_RGBA8_UNORM, .width = SIZE, .height = SIZE};
    must(rhw_buffer_create(context, &corner_def, &scene->corners), "corners");
    must(rhw_buffer_create(context, &index_def, &scene->indices), "indices");
    must(rhw_texture_create(context, &def, &scene->picture), "picture");
    scene->flat = make_pipeline(context, RHW_FLAT);
    scene->smooth = make_pipeline(context, RHW_SMOOTH);
}

static void draw(rhw_context *context, const struct scene *scene, float angle)
{
    const struct rhw_pass_def def = {.colors = {{.texture = scene->picture, .clear = {0, 0, 0, 1}}},
                                     .color_count = 1,
                                     .depth = {.enabled = true, .store = RHW_STORE_DISCARD}};
    rhw_pass pass;
    must(rhw_pass_begin(context, &def, &pass), "begin");
    rhw_pass_set_vertex_buffer(context, pass, 0, scene->corners, 0);
    rhw_pass_set_index_buffer(context, pass, scene->indices, RHW_INDEX_UINT16, 0);
    for (int g = 0; g < GEARS; g++) {
        const struct span flat = scene->mesh.flat[g], smooth = scene->mesh.smooth[g];
        struct placed placed;
        place(&gears[g], angle, &placed);
        rhw_pass_set_uniforms(context, pass, &placed, sizeof placed);
        rhw_pass_set_pipeline(context, pass, scene->flat);
        rhw_pass_draw_indexed(context, pass, flat.first, flat.count, 0, 0, 1);
        rhw_pass_set_pipeline(context, pass, scene->smooth);
        rhw_pass_draw_indexed(context, pass, smooth.first, smooth.count, 0, 0, 1);
    }
    must(rhw_pass_end(context, pass, NULL), "end");
}

// Checks --------------------------------------------------------------------------------------------

// Whether a pixel has a colour: where a point lands that lies at a radius and an angle from a gear's middle.
static bool shows(unsigned char (*pixels)[4], int gear, float radius, double degrees, float z,
                  const int color[3])
{
    struct placed upright;
    float turned[2], landed[3];
    place(&gears[gear], -gears[gear].phase / gears[gear].speed, &upright);
    turn(degrees, turned);
    matrix_land(upright.clip, (float[]){radius * turned[0], radius * turned[1], z}, SIZE, SIZE, landed);
    const unsigned char *pixel = pixels[(int)landed[1] * SIZE + (int)landed[0]];
    bool same = true;
    for (int c = 0; c < 3; c++) {
        same = same && abs(pixel[c] - color[c]) <= 2;
    }
    return same;
}

int main(int argc, char **argv)
{
    struct outside outside = outside_options(argc, argv);
    rhw_context *context;
    must(rhw_context_create(&outside.context_def, &context), "context");
    static struct scene scene;
    make_scene(context, &scene);

    // Turned by 30° about y and 20° about x, a face looks along (0.5, −0.2962, 0.8138). By the light's
    // (1, 1, 2) / √6 that is 0.7477: with the ambient 0.2, 0.9477 of the gear's colour, at every angle.
    static const int faces[GEARS][3] = {{193, 24, 0}, {0, 193, 48}, {48, 48, 242}}, black[3] = {0};
    // The wall of the hole at −36° looks along (−0.7006, 0.4142, 0.5812): 0.3577 + 0.2.
    static const int wall[3] = {114, 14, 0};
    static const struct {
        const char *name;
        float angle;
    } pictures[] = {{"gears.0", 0}, {"gears.6", 6}, {"gears.100", 100}};
    for (int i = 0; i < 3; i++) {
        draw(context, &scene, pictures[i].angle);
        unsigned char(*pixels)[4] = outside_show(&outside, context, pictures[i].name, scene.picture);
        check(&outside, shows(pixels, 0, 2.5f, 180, 0.5f, faces[0]), "the face of the red gear");
        check(&outside, shows(pixels, 1, 1, 0, 1, faces[1]), "the face of the green gear");
        check(&outside, shows(pixels, 2, 1.5f, 180, 0.25f, faces[2]), "the face of the blue gear");
        check(&outside, shows(pixels, 0, 0, 0, 0, black), "the red gear has a hole");
        // The middle of a tooth is 6.75° from its beginning, that of a gap 15.75°; tooth 10 lies left.
        const double tooth = 180 + (double)pictures[i].angle;
        check(&outside, shows(pixels, 0, 4.1f, tooth + 6.75, 0.5f, faces[0]), "a tooth of the red gear");
        check(&outside, !shows(pixels, 0, 4.1f, tooth + 15.75, 0.5f, faces[0]), "a gap of the red gear");
        if (i == 0) {
            check(&outside, shows(pixels, 0, 1, -36, 0.25f, wall), "the wall of the red gear's hole");
        }
        // 18° further is a tooth for each gear.
        static unsigned char later[SIZE * SIZE][4];
        draw(context, &scene, pictures[i].angle + 18);
        must(rhw_texture_read(context, scene.picture, 0, later, 0), "later");
        check(&outside, memcmp(pixels, later, sizeof later) == 0, "a tooth further all looks the same");
        free(pixels);
    }
    for (int degrees = -720; degrees <= 720; degrees += 3) {
        float turned[2], sine, cosine;
        turn(degrees, turned);
        rhw_sincos1((float)degrees * 0.0174532925f, &sine, &cosine);
        check(&outside, rhw_abs1(turned[0] - cosine) < 1e-6f, "the cosine is that of rhw");
        check(&outside, rhw_abs1(turned[1] - sine) < 1e-6f, "the sine is that of rhw");
    }
    rhw_context_destroy(context);
    return outside.failures != 0;
}
