// SPDX-License-Identifier: MIT
// What the properties of a 3MF make of a triangle's corner, and the materials that come of it. Colours go to the
// vertices; a material is needed for each texture, metal and kind of transparency only.
#include <string.h>

#include "threemf.h"
#include "import/builder/name_forms.h"
#include "import/builder/phong.h"
#include "import/builder/zip.h"

struct scene_3mf_group *scene_3mf_find_group(const struct scene_3mf *file, uint32_t part, uint32_t id)
{
    size_t low = 0, high = file->group_count;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        const struct scene_3mf_group *group = &file->groups[middle];
        if (group->part < part || (group->part == part && group->id < id)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    struct scene_3mf_group *group = &file->groups[low];
    return low < file->group_count && group->part == part && group->id == id ? group : NULL;
}

// Display properties tell how a base material or a colour shines: one for each, or one for all.
static void apply_display(const struct scene_3mf *file, uint32_t part, uint32_t id, uint32_t index,
                          struct scene_3mf_paint *paint)
{
    const struct scene_3mf_group *group = id == 0 ? NULL : scene_3mf_find_group(file, part, id);
    if (group == NULL || group->count == 0 ||
        (group->kind != SCENE_3MF_METALS && group->kind != SCENE_3MF_SPECULARS)) {
        return;
    }
    const float *value = file->properties[group->first + (index < group->count ? index : 0)].value;
    paint->metallic = group->kind == SCENE_3MF_METALS ? value[0] : 0;
    paint->roughness = value[1];
}

// A composite is a mixture of base materials; the shares are scaled to add up to 1 (Materials, 4).
static void mix_composite(const struct scene_3mf *file, const struct scene_3mf_group *group,
                          const struct scene_3mf_property *property, struct scene_3mf_paint *paint)
{
    const struct scene_3mf_group *bases = scene_3mf_find_group(file, group->part, group->refers);
    float sum = 0, color[4] = {0, 0, 0, 0};
    for (size_t i = 0; i < property->list_count && i < group->list_count && bases != NULL; i++) {
        const double share = file->lists[property->list + i], index = file->lists[group->list + i];
        if (!(share > 0 && share <= 1e6) || !(index >= 0 && index < (double)bases->count)) {
            continue;
        }
        const float *base = file->properties[bases->first + (size_t)index].value;
        for (int c = 0; c < 4; c++) {
            color[c] += (float)share * base[c];
        }
        sum += (float)share;
    }
    for (int c = 0; c < 4 && sum > 0; c++) {
        paint->color[c] = color[c] / sum;
    }
}

static bool same_place(const struct scene_3mf_paint *a, const struct scene_3mf_paint *b)
{
    return a->uv[0] == b->uv[0] && a->uv[1] == b->uv[1];
}

// One layer above what there is (Materials, 5). A texture that is mixed lets shine through what lies below, as far as
// that has the same coordinates.
static void lay(struct scene_3mf_paint *paint, const struct scene_3mf_paint *above, bool multiplied)
{
    const float alpha = above->color[3];
    if (above->texture != NULL && !multiplied) {
        paint->below = paint->texture != NULL && same_place(paint, above) ? paint->texture : NULL;
        if (!paint->layered) {
            memcpy(paint->ground, paint->color, sizeof paint->ground);
        }
        paint->layered = true;
    }
    for (int c = 0; c < 3; c++) {
        paint->color[c] = multiplied ? paint->color[c] * above->color[c]
                                     : above->color[c] * alpha + paint->color[c] * (1 - alpha);
    }
    paint->color[3] = multiplied ? paint->color[3] * alpha : alpha + paint->color[3] * (1 - alpha);
    if (above->texture != NULL) {
        paint->texture = above->texture;
        memcpy(paint->uv, above->uv, sizeof paint->uv);
    } else if (!multiplied && alpha >= 1) {
        paint->texture = paint->below = NULL;
        paint->layered = false;
        memset(paint->ground, 0, sizeof paint->ground);
    }
    if (above->roughness >= 0) {
        paint->metallic = above->metallic;
        paint->roughness = above->roughness;
    }
}

static const struct scene_3mf_paint plain = {.color = {1, 1, 1, 1}, .metallic = -1, .roughness = -1};

// Properties that are no multiproperties.
static struct scene_3mf_paint find_single(const struct scene_3mf *file, const struct scene_3mf_group *group,
                                          uint32_t index)
{
    struct scene_3mf_paint paint = plain;
    if (group == NULL || index >= group->count) {
        return paint;
    }
    const struct scene_3mf_property *property = &file->properties[group->first + index];
    paint.described = true;
    switch (group->kind) {
    case SCENE_3MF_BASES:
    case SCENE_3MF_COLORS: memcpy(paint.color, property->value, sizeof paint.color); break;
    case SCENE_3MF_COMPOSITES: mix_composite(file, group, property, &paint); break;
    case SCENE_3MF_COORDS:
        paint.texture = scene_3mf_find_group(file, group->part, group->refers);
        if (paint.texture != NULL && paint.texture->kind != SCENE_3MF_TEXTURE) {
            paint.texture = NULL;
        }
        paint.uv[0] = property->value[0];
        paint.uv[1] = 1 - property->value[1]; // the format's v points up
        break;
    default: return plain;
    }
    apply_display(file, group->part, property->display != 0 ? property->display : group->display, index,
                  &paint);
    return paint;
}

struct scene_3mf_paint scene_3mf_find_paint(const struct scene_3mf *file, const struct scene_3mf_group *group,
                                            uint32_t index)
{
    if (group == NULL || group->kind != SCENE_3MF_MULTI || index >= group->count) {
        return find_single(file, group, index);
    }
    const struct scene_3mf_property *property = &file->properties[group->first + index];
    struct scene_3mf_paint paint = plain;
    for (size_t i = 0; i < group->list_count; i++) {
        const double id = file->lists[group->list + i];
        const double place = i < property->list_count ? file->lists[property->list + i] : 0;
        if (!(id >= 0 && id <= INT32_MAX && place >= 0 && place <= INT32_MAX)) {
            continue;
        }
        const struct scene_3mf_paint above =
            find_single(file, scene_3mf_find_group(file, group->part, (uint32_t)id), (uint32_t)place);
        if (above.described && !paint.described) {
            paint = above;
        } else if (above.described) {
            if (above.texture != NULL &&
                (paint.below != NULL || (paint.texture != NULL && !same_place(&paint, &above)))) {
                scene_import_unsupported(file->import,
                                         "textures above others (3MF): those at the bottom are left out");
            }
            lay(&paint, &above, i > 0 && i <= 64 && (group->multiplied >> (i - 1) & 1) != 0);
        }
    }
    return paint;
}

// Materials -----------------------------------------------------------------------------------------

// Read the part of the archive that a path means. Return NULL if there is none.
static void *read_part(struct scene_3mf *file, const char *path, size_t *size)
{
    path += path[0] == '/';
    void *bytes = scene_zip_read_all(file->zip, path, size);
    if (bytes == NULL && path[0] != 0) { // some writers give a path from the model's folder
        const char *slash = strrchr(path, '/');
        const char *moved = scene_zip_find_ending(file->zip, slash == NULL ? path : slash);
        bytes = moved == NULL ? NULL : scene_zip_read_all(file->zip, moved, size);
    }
    return bytes;
}

// The image of a texture, which is read when the first triangle shows it.
static int32_t find_image(struct scene_3mf *file, struct scene_3mf_group *texture)
{
    if (texture->image < 0) {
        struct scene_import_source source = {.opacity_image = -1, .problem = "is not in the archive"};
        const char *path = texture->path[0] == '/' ? texture->path + 1 : texture->path;
        struct scene_name_forms forms = {.count = 0};
        scene_name_forms_add(file->import, &forms, path);
        for (size_t i = 0; i < forms.count && source.bytes == NULL; i++) {
            source.bytes = read_part(file, forms.names[i], &source.size);
        }
        scene_name_forms_free(&forms);
        texture->image = scene_import_add_image(file->import, path, &source);
    }
    return texture->image;
}

// The image of a texture over what lies below it.
static int32_t add_layered_image(struct scene_3mf *file, const struct scene_3mf_paint *paint)
{
    struct scene_import *import = file->import;
    struct scene_import_layer *layer = scene_import_allocate(import, 1, sizeof *layer);
    layer->image = paint->below == NULL ? -1 : find_image(file, paint->below);
    memcpy(layer->color, paint->ground, sizeof layer->color);
    const int32_t top = find_image(file, paint->texture);
    struct scene_import_source source = import->sources[top];
    source.layer = layer;
    return scene_import_add_image(import, import->model.images[top].name, &source);
}

// Show what lies below a texture where it is not repeated, as a surface that is not described where nothing does. What
// is blended is seen through there.
static void set_border(const struct scene_3mf_paint *paint, bool blended, float border[4])
{
    const float grey = 0.6f;
    for (int c = 0; c < 3; c++) {
        border[c] = blended ? 0 : paint->layered ? paint->ground[c] : grey;
    }
    border[3] = blended ? 0 : 1;
}

static uint32_t add_material(struct scene_3mf *file, const struct scene_3mf_paint *paint, bool blended)
{
    struct scene_phong phong = scene_phong_default();
    phong.colored = paint->described;
    phong.metallic = paint->metallic;
    phong.roughness = paint->roughness;
    const int32_t image = paint->texture == NULL ? -1
                          : paint->layered       ? add_layered_image(file, paint)
                                                 : find_image(file, paint->texture);
    const uint32_t index = scene_phong_add(file->import, &phong);
    struct scene_material *material = &file->import->model.materials[index];
    material->alpha_mode = blended ? SCENE_ALPHA_BLEND : SCENE_ALPHA_OPAQUE;
    if (image >= 0) {
        struct scene_texture_slot *slot = &material->slots[SCENE_SLOT_BASE_COLOR];
        slot->image = image;
        slot->address_u = paint->texture->address_u;
        slot->address_v = paint->texture->address_v;
        slot->min_filter = slot->mag_filter = paint->texture->filter;
        set_border(paint, blended, slot->border);
    }
    return index;
}

// Each is a copy of its texture.
enum { MOST_LAYERED = 64 };

static bool same_look(const struct scene_3mf_paint *a, const struct scene_3mf_paint *b)
{
    return a->texture == b->texture && a->described == b->described && a->metallic == b->metallic &&
           a->roughness == b->roughness && a->layered == b->layered && a->below == b->below &&
           memcmp(a->ground, b->ground, sizeof a->ground) == 0;
}

uint32_t scene_3mf_material(struct scene_3mf *file, const struct scene_3mf_paint *paint, bool blended)
{
    for (size_t i = file->look_count; i > 0; i--) {
        const struct scene_3mf_look *look = &file->looks[i - 1];
        if (look->blended == blended && same_look(&look->paint, paint)) {
            return look->material;
        }
    }
    if (paint->layered && file->layered_count == MOST_LAYERED) {
        struct scene_3mf_paint above = *paint; // without what lies below
        scene_import_unsupported(file->import, "what lies below textures: in %d colours alone", MOST_LAYERED);
        above.layered = false;
        above.below = NULL;
        memset(above.ground, 0, sizeof above.ground);
        return scene_3mf_material(file, &above, blended);
    }
    file->layered_count += paint->layered;
    const uint32_t material = add_material(file, paint, blended);
    scene_import_reserve(file->import, &file->looks, &file->look_capacity, file->look_count + 1,
                         sizeof *file->looks);
    file->looks[file->look_count++] = (struct scene_3mf_look){*paint, blended, material};
    return material;
}
