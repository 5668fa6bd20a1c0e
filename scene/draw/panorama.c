// SPDX-License-Identifier: MIT
#include "panorama.h"

#include "draw/camera/camera_math.h"
#include "rhw/transfer.h"
#include "screen.h"

#include <stdlib.h>
#include <string.h>

enum { SOURCE_SIDE = 256, CUBE_SIDE = 512, CUBE_LEVELS = 6 };

static const double pi = 3.14159265358979323846;
static const double mean_light = 0.75;
// A sun holds at least this part of all light within this angle.
static const double sun_part = 0.15, sun_angle = 0.12;

// Directions ----------------------------------------------------------------------------------------

// Rows of the matrix that takes a direction of the world to one of the panorama, whose up is +Y.
static void set_turn(enum scene_axis up, double rotation, float turn[3][3])
{
    double sine, cosine;
    scene_sin_cos_degrees(rotation, &sine, &cosine);
    double axes[3][3] = {{cosine, 0.0, sine}, {0.0, 1.0, 0.0}, {-sine, 0.0, cosine}};
    for (int r = 0; r < 3; r++) {
        scene_axis_turn(up, axes[r]);
        for (int c = 0; c < 3; c++) {
            turn[r][c] = (float)axes[r][c];
        }
    }
}

static void to_world(float turn[3][3], const double own[3], double world[3])
{
    for (int c = 0; c < 3; c++) {
        world[c] = (double)turn[0][c] * own[0] + (double)turn[1][c] * own[1] + (double)turn[2][c] * own[2];
    }
}

struct row {
    double y, across, solid_angle; // the direction's height, and its distance from the axis; of a texel
};

static struct row find_row(const struct scene_panorama *p, int y)
{
    const double angle = pi * (y + 0.5) / p->height;
    const double above = scene_cos(pi * y / p->height), below = scene_cos(pi * (y + 1) / p->height);
    return (struct row){scene_cos(angle), scene_sin(angle), (above - below) * 2.0 * pi / p->width};
}

// The question whether the picture is still wanted. It is asked before each row. A row of a large panorama is
// some 100 µs of work. Loops end at the first no, and `measure` then drops what they found.
struct asking {
    const struct scene_view *view;
    bool gave_up;
};

static bool goes_on(struct asking *asking)
{
    const struct scene_view *const view = asking->view;
    asking->gave_up = asking->gave_up || (view->goes_on && !view->goes_on(view->user));
    return !asking->gave_up;
}

static double luminance(const float texel[4])
{
    return 0.2126 * (double)texel[0] + 0.7152 * (double)texel[1] + 0.0722 * (double)texel[2];
}

// Light ---------------------------------------------------------------------------------------------

struct column {
    double x, z;
};

static struct column *find_columns(const struct scene_panorama *p)
{
    struct column *columns = malloc((size_t)p->width * sizeof *columns);
    for (int x = 0; columns && x < p->width; x++) {
        const double angle = 2.0 * pi * ((x + 0.5) / p->width - 0.5);
        columns[x] = (struct column){scene_cos(angle), scene_sin(angle)};
    }
    return columns;
}

static double total_light(const struct scene_panorama *p, struct asking *asking)
{
    double total = 0.0;
    for (int y = 0; y < p->height && goes_on(asking); y++) {
        double sum = 0.0;
        for (int x = 0; x < p->width; x++) {
            sum += luminance(p->texels[(size_t)y * (size_t)p->width + (size_t)x]);
        }
        total += sum * find_row(p, y).solid_angle;
    }
    return total;
}

static size_t find_brightest(const struct scene_panorama *p, struct asking *asking)
{
    const size_t width = (size_t)p->width;
    size_t brightest = 0;
    for (size_t y = 0; y < (size_t)p->height && goes_on(asking); y++) {
        for (size_t i = y * width; i < (y + 1) * width; i++) {
            brightest = luminance(p->texels[i]) > luminance(p->texels[brightest]) ? i : brightest;
        }
    }
    return brightest;
}

// Takes a sun out of the panorama: what around the brightest texel is brighter than ten times the mean. `direction` and
// `light` (irradiance of what faces it) are of the panorama's own axes and numbers.
static void take_sun(struct scene_panorama *p, const struct column *columns, double total,
                     double direction[3], double light[3], struct asking *asking)
{
    const double limit = 10.0 * total / (4.0 * pi);
    const size_t brightest = find_brightest(p, asking);
    const struct row top = find_row(p, (int)(brightest / (size_t)p->width));
    const struct column middle = columns[brightest % (size_t)p->width];
    const double ahead[3] = {middle.x * top.across, top.y, middle.z * top.across};
    double mean[3] = {0}, found[3] = {0}, taken = 0.0;
    const double nearest = scene_cos(sun_angle);
    for (int pass = 0; pass < 2; pass++) {
        for (int y = 0; y < p->height && goes_on(asking); y++) {
            const struct row row = find_row(p, y);
            for (int x = 0; x < p->width; x++) {
                const double d[3] = {columns[x].x * row.across, row.y, columns[x].z * row.across};
                float *texel = p->texels[(size_t)y * (size_t)p->width + (size_t)x];
                const double bright = luminance(texel);
                if (scene_dot(d, ahead) < nearest || bright <= limit) {
                    continue;
                }
                const double part = 1.0 - limit / bright;
                if (pass == 0) {
                    taken += part * bright * row.solid_angle;
                }
                for (int c = 0; c < 3 && pass == 1; c++) {
                    const double share = part * (double)texel[c] * row.solid_angle;
                    found[c] += share;
                    texel[c] = (float)((double)texel[c] * (1.0 - part));
                    mean[c] += d[c] * part * bright * row.solid_angle;
                }
            }
        }
        if (taken < sun_part * total) {
            return;
        }
    }
    const double length = __builtin_sqrt(scene_dot(mean, mean));
    for (int c = 0; c < 3; c++) {
        direction[c] = mean[c] / length;
        light[c] = found[c];
    }
}

// Irradiance / π as a polynomial of the normal in the world: harmonics of order 2 times those of the clamped
// cosine, 1, 2/3 and 1/4 of π.
static void find_harmonics(const struct scene_panorama *p, const struct column *columns, float turn[3][3],
                           double k[9][3], struct asking *asking)
{
    for (int y = 0; y < p->height && goes_on(asking); y++) {
        const struct row row = find_row(p, y);
        for (int x = 0; x < p->width; x++) {
            const float *texel = p->texels[(size_t)y * (size_t)p->width + (size_t)x];
            const double own[3] = {columns[x].x * row.across, row.y, columns[x].z * row.across};
            double d[3];
            to_world(turn, own, d);
            const double products[9] = {1.0,
                                        d[0],
                                        d[1],
                                        d[2],
                                        d[0] * d[1],
                                        d[1] * d[2],
                                        d[2] * d[0],
                                        3.0 * d[2] * d[2] - 1.0,
                                        d[0] * d[0] - d[1] * d[1]};
            for (int i = 0; i < 9; i++) {
                for (int c = 0; c < 3; c++) {
                    k[i][c] += (double)texel[c] * products[i] * row.solid_angle;
                }
            }
        }
    }
    // The squared norms of the harmonics, each with the factor of its order.
    static const double norms[9] = {0.25,        0.5,         0.5,        0.5,        15.0 / 16.0,
                                    15.0 / 16.0, 15.0 / 16.0, 5.0 / 64.0, 15.0 / 64.0};
    for (int i = 0; i < 9; i++) {
        for (int c = 0; c < 3; c++) {
            k[i][c] *= norms[i] / pi;
        }
    }
}

// Sets what shaders need but the pictures. `p` loses its sun.
static enum rhw_result measure(struct scene_surroundings *s, struct scene_panorama *p, float turn[3][3],
                               struct asking *asking)
{
    struct column *columns = find_columns(p);
    if (!columns) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    const double total = total_light(p, asking), strength = total > 0.0 ? mean_light * 4.0 * pi / total : 0.0;
    double ahead[3] = {0}, toward[3], light[3] = {0}, k[9][3] = {{0}};
    take_sun(p, columns, total, ahead, light, asking);
    find_harmonics(p, columns, turn, k, asking);
    free(columns);
    to_world(turn, ahead, toward);
    s->environment = (struct scene_environment){
        .mapped = 1, .levels = (float)(CUBE_LEVELS - 1), .strength = (float)strength};
    s->sun = (struct scene_shader_light){.type = SCENE_LIGHT_DIRECTIONAL};
    for (int c = 0; c < 3; c++) {
        s->sun.direction[c] = (float)toward[c];
        s->sun.color[c] = (float)(light[c] * strength);
        for (int i = 0; i < 9; i++) {
            s->environment.irradiance[i][c] = (float)(k[i][c] * strength);
        }
    }
    return asking->gave_up ? RHW_ERROR_GIVEN_UP : RHW_OK;
}

// Passes --------------------------------------------------------------------------------------------

// Vulkan 1.3, "Cube Map Face Selection": u and v of a face in the world.
static void set_face(struct scene_panorama_pass *pass, int face, int side)
{
    static const float axes[6][3][3] = {
        {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
        {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},   {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
        {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},  {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
    memcpy(pass->axes, axes[face], sizeof pass->axes);
    for (int i = 0; i < 2; i++) {
        pass->scale[i] = 2.0f / (float)side;
        pass->offset[i] = -1.0f;
    }
}

// Directions in which a surface of that roughness mirrors what it is looked at from straight above, evenly by GGX's
// distribution, each with the level of a cube of `side` whose texels are as large as its share of directions.
static void set_samples(struct scene_panorama_pass *pass, int count, double roughness, int side)
{
    const double alpha = roughness * roughness, alpha2 = alpha * alpha;
    pass->sample_count = count;
    for (int i = 0; i < count; i++) {
        double reversed = 0.0, place = 0.5;
        for (int bits = i; bits > 0; bits >>= 1, place *= 0.5) {
            reversed += bits & 1 ? place : 0.0;
        }
        const double part = (i + 0.5) / count, angle = 2.0 * pi * reversed;
        const double cos2 = (1.0 - part) / (1.0 + (alpha2 - 1.0) * part), cosine = __builtin_sqrt(cos2);
        const double sine = __builtin_sqrt(1.0 - cos2), base = cos2 * (alpha2 - 1.0) + 1.0;
        const double density = alpha2 / (pi * base * base) / 4.0;
        const double share = 1.0 / (count * density), texel = 4.0 * pi / (6.0 * side * side);
        const double level = 0.5 * scene_log(share / texel) / scene_log(2.0) + 1.0;
        float *sample = pass->samples[i];
        // The half vector turned into the direction of light.
        sample[0] = (float)(2.0 * cosine * sine * scene_cos(angle));
        sample[1] = (float)(2.0 * cosine * sine * scene_sin(angle));
        sample[2] = (float)(2.0 * cos2 - 1.0);
        sample[3] = level > 0.0 ? (float)level : 0.0f;
        if (sample[2] <= 0.0f) { // below the surface
            memset(sample, 0, sizeof pass->samples[i]);
            sample[0] = 1.0f;
        }
    }
}

static enum rhw_result draw_face(rhw_context *context, enum scene_screen_kind kind,
                                 const struct scene_panorama_pass *uniforms, rhw_texture source,
                                 rhw_sampler sampler, rhw_texture cube, int face, int level)
{
    static const enum rhw_format format = RHW_FORMAT_RGBA16_FLOAT;
    struct rhw_pass_def def = rhw_pass_def_default();
    def.color_count = 1;
    def.colors[0] = (struct rhw_color_attachment){
        .texture = cube, .load = RHW_LOAD_DISCARD, .layer = face, .level = level};
    def.depth = (struct rhw_depth_attachment){.enabled = false};
    rhw_pass pass;
    enum rhw_result result = rhw_pass_begin(context, &def, &pass);
    if (result == RHW_OK) {
        rhw_pass_set_texture(context, pass, 0, source, sampler);
        result = scene_screen_record(context, pass, kind, &format, 1, uniforms);
        result = scene_pass_end(context, pass, result, NULL);
    }
    return result;
}

static enum rhw_result create_cube(rhw_context *context, int side, int levels, rhw_texture *cube)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.kind = RHW_TEXTURE_CUBE;
    def.format = RHW_FORMAT_RGBA16_FLOAT;
    def.width = def.height = side;
    def.mip_levels = levels;
    return rhw_texture_create(context, &def, cube);
}

// The level of the picture whose texels are as large as those of a face.
static float picture_level(const struct scene_panorama *p, double radians_per_pixel)
{
    const double level = scene_log(radians_per_pixel * p->width / (2.0 * pi)) / scene_log(2.0);
    return level > 0.0 ? (float)level : 0.0f;
}

static enum rhw_result draw_panorama(struct scene_surroundings *s, rhw_context *context,
                                     struct scene_panorama_pass *pass, rhw_texture cube, int side)
{
    enum rhw_result result = RHW_OK;
    pass->strength = 1.0f;
    pass->level = picture_level(s->panorama, 0.5 * pi / side);
    for (int face = 0; face < 6 && result == RHW_OK; face++) {
        set_face(pass, face, side);
        result =
            draw_face(context, SCENE_SCREEN_PANORAMA, pass, s->picture, s->picture_sampler, cube, face, 0);
    }
    return result;
}

static enum rhw_result draw_cube(struct scene_surroundings *s, rhw_context *context, float turn[3][3])
{
    struct scene_panorama_pass *pass = calloc(1, sizeof *pass);
    rhw_texture source = {0};
    enum rhw_result result =
        pass ? create_cube(context, SOURCE_SIDE, RHW_MIP_LEVELS_ALL, &source) : RHW_ERROR_OUT_OF_MEMORY;
    if (result == RHW_OK) {
        memcpy(pass->turn, turn, sizeof pass->turn);
        result = draw_panorama(s, context, pass, source, SOURCE_SIDE);
    }
    if (result == RHW_OK) {
        result = rhw_texture_generate_mips(context, source);
    }
    if (result == RHW_OK) {
        result = create_cube(context, CUBE_SIDE, CUBE_LEVELS, &s->cube);
    }
    if (result == RHW_OK) {
        result = draw_panorama(s, context, pass, s->cube, CUBE_SIDE);
    }
    for (int level = 1; level < CUBE_LEVELS && result == RHW_OK; level++) {
        // The sharper a reflection, the fewer samples do.
        set_samples(pass, level < 3 ? 8 << level : SCENE_PREFILTER_SAMPLES, (double)level / (CUBE_LEVELS - 1),
                    SOURCE_SIDE);
        for (int face = 0; face < 6 && result == RHW_OK; face++) {
            set_face(pass, face, CUBE_SIDE >> level);
            result = draw_face(context, SCENE_SCREEN_PREFILTER, pass, source, s->cube_sampler, s->cube, face,
                               level);
        }
    }
    if (source.generation) {
        rhw_texture_destroy(context, source);
    }
    free(pass);
    return result;
}

static enum rhw_result create_samplers(struct scene_surroundings *s, rhw_context *context)
{
    struct rhw_sampler_def def = rhw_sampler_def_default();
    enum rhw_result result = rhw_sampler_create(context, &def, &s->cube_sampler);
    def.address_v = RHW_ADDRESS_CLAMP;
    if (result == RHW_OK) {
        result = rhw_sampler_create(context, &def, &s->picture_sampler);
    }
    return result;
}

static enum rhw_result create_picture(struct scene_surroundings *s, rhw_context *context,
                                      const struct scene_panorama *p)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = RHW_FORMAT_RGBA32_FLOAT;
    def.width = p->width;
    def.height = p->height;
    def.mip_levels = RHW_MIP_LEVELS_ALL;
    enum rhw_result result = rhw_texture_create(context, &def, &s->picture);
    if (result == RHW_OK) {
        result = rhw_texture_write(context, s->picture, 0, p->texels, 0);
    }
    return result == RHW_OK ? rhw_texture_generate_mips(context, s->picture) : result;
}

static void copy_rows(const struct scene_panorama *from, const struct scene_panorama *to,
                      struct asking *asking)
{
    const size_t width = (size_t)from->width;
    for (size_t y = 0; y < (size_t)from->height && goes_on(asking); y++) {
        memcpy(to->texels[y * width], from->texels[y * width], width * sizeof *to->texels);
    }
}

// Light comes from a copy without the sun, the background shows it.
static enum rhw_result make(struct scene_surroundings *s, rhw_context *context, const struct scene_view *view)
{
    const struct scene_panorama *const panorama = view->panorama;
    const size_t size = (size_t)panorama->width * (size_t)panorama->height * sizeof *panorama->texels;
    struct scene_panorama copy = *panorama;
    struct asking asking = {.view = view};
    float turn[3][3];
    set_turn(s->up, s->rotation, turn);
    copy.texels = malloc(size);
    if (!copy.texels) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    copy_rows(panorama, &copy, &asking);
    enum rhw_result result = measure(s, &copy, turn, &asking);
    if (result == RHW_OK) {
        result = create_samplers(s, context);
    }
    if (result == RHW_OK) {
        result = create_picture(s, context, &copy);
    }
    free(copy.texels);
    if (result == RHW_OK) {
        result = draw_cube(s, context, turn);
    }
    if (result == RHW_OK && s->sun.color[1] > 0.0f) {
        rhw_texture_destroy(context, s->picture);
        s->picture = (rhw_texture){0};
        result = create_picture(s, context, panorama);
    }
    return result;
}

enum rhw_result scene_surroundings_make(struct scene_surroundings *s, rhw_context *context,
                                        const struct scene_view *view)
{
    const double rotation = view->panorama_rotation;
    const bool same = s->panorama == view->panorama && s->up == view->up &&
                      !(s->rotation < rotation || s->rotation > rotation);
    if (same) {
        return RHW_OK;
    }
    scene_surroundings_destroy(context, s);
    s->panorama = view->panorama;
    s->up = view->up;
    s->rotation = rotation;
    const enum rhw_result result = make(s, context, view);
    if (result != RHW_OK) {
        scene_surroundings_destroy(context, s);
    }
    return result;
}

void scene_surroundings_destroy(rhw_context *context, struct scene_surroundings *s)
{
    const rhw_texture textures[] = {s->picture, s->cube};
    const rhw_sampler samplers[] = {s->picture_sampler, s->cube_sampler};
    for (int i = 0; i < 2; i++) {
        if (textures[i].generation) {
            rhw_texture_destroy(context, textures[i]);
        }
        if (samplers[i].generation) {
            rhw_sampler_destroy(context, samplers[i]);
        }
    }
    *s = (struct scene_surroundings){0};
}

struct scene_panorama_pass scene_surroundings_background(const struct scene_surroundings *s,
                                                         const struct scene_view *view)
{
    const struct scene_camera *camera = &view->camera;
    double matrix[16];
    scene_camera_view(camera, matrix);
    // An orthographic camera has no angle of view, but a background all of one colour would be no background.
    const double yfov = camera->orthographic ? scene_camera_default_yfov() : camera->yfov;
    const double stretch = camera->stretch > 0.0 ? camera->stretch : 1.0;
    const double up = scene_tangent_of_half(yfov), right = up * view->width / view->height / stretch;
    struct scene_panorama_pass pass = {.level = picture_level(s->panorama, 2.0 * up / view->height),
                                       .strength = s->environment.strength};
    for (int c = 0; c < 3; c++) {
        pass.axes[0][c] = (float)(matrix[4 * c] * right);
        pass.axes[1][c] = (float)(-matrix[4 * c + 1] * up);
        pass.axes[2][c] = (float)(-matrix[4 * c + 2] - matrix[4 * c] * right * camera->shift[0] -
                                  matrix[4 * c + 1] * up * camera->shift[1]);
    }
    set_turn(s->up, s->rotation, pass.turn);
    return pass;
}
