// SPDX-License-Identifier: MIT
// What rhw info prints of a model, as text (info_text.c) and as JSON (info_json.c), and what both count and call alike
// (info_count.c).
#ifndef CLI_INFO_PRINT_H
#define CLI_INFO_PRINT_H

#include "model.h"

void cli_info_print_text(const struct scene_model *model);
void cli_info_print_json(const struct scene_model *model);

// By the enums of model.h.
extern const char *const cli_primitive_names[];
extern const char *const cli_image_type_names[];
extern const char *const cli_alpha_names[];
extern const char *const cli_light_names[];
extern const char *const cli_slot_names[SCENE_SLOT_COUNT];
// By those of the library.
extern const char *const cli_filter_names[];
extern const char *const cli_mip_filter_names[];
extern const char *const cli_address_names[];

uint32_t cli_info_objects(const struct scene_model *model);
/// Lines, points or triangles.
uint32_t cli_info_elements(const struct scene_mesh *mesh);
/// Digits for places of the model in the coordinates of its file: `near`, and far from the origin as many more as the
/// distance takes.
int cli_info_digits(const struct scene_model *model, int near);
/// Find a place in the coordinates of the file, of which a model has floats and what it knows more exactly. Return true
/// if the floats lose digits of it that can be seen. Otherwise write what they are.
bool cli_info_find_place(const struct scene_model *model, const float floats[3], const double exact[3],
                         double place[3]);
bool cli_info_draws_anything(const struct scene_model *model);
/// Bytes of vertices and indices, and of textures with their mip chains, when they are drawn.
uint64_t cli_info_mesh_bytes(const struct scene_model *model);
uint64_t cli_info_texture_bytes(const struct scene_model *model);

#endif
