// SPDX-License-Identifier: MIT
// Golden images of real models: files of Debian's assimp-testmodels and glmark2-data, imported and drawn as
// `rhw render` does, every output in the hash. A file that is not installed is skipped. A newer assimp may
// read a file otherwise: then the table needs --update, after a look at the pictures.
#include "golden.h"

#include "draw/draw.h"
#include "model.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WIDTH = 160, HEIGHT = 120 };

static const char *const models[] = {
    "/usr/share/assimp/models/OBJ/spider.obj",
    "/usr/share/assimp/models/Collada/duck.dae",
    "/usr/share/assimp/models/glTF2/BoxTextured-glTF-Binary/BoxTextured.glb",
    "/usr/share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb",
    "/usr/share/assimp/models/PLY/Wuson.ply",
    "/usr/share/assimp/models/3DS/test1.3ds",
    "/usr/share/assimp/models/X/kwxport_test_cubewithvcolors.x",
    "/usr/share/glmark2/models/bunny.obj",
    "/usr/share/glmark2/models/horse.3ds",
};

static struct scene_model *loaded;
static int loaded_number = -1;

static const struct scene_model *load(int number)
{
    if (loaded_number != number) {
        scene_model_free(loaded);
        char error[512];
        loaded = scene_model_load(models[number], NULL, error, sizeof error);
        loaded_number = number;
        if (loaded == NULL) {
            fprintf(stderr, "golden: %s: %s\n", models[number], error);
            exit(2);
        }
    }
    return loaded;
}

static uint64_t hash_plane(uint64_t hash, const void *plane, size_t texel)
{
    return plane != NULL ? golden_hash(hash, plane, texel * WIDTH * HEIGHT) : hash;
}

static uint64_t hash_model(int number, const struct rhw_context_def *def)
{
    if (access(models[number], R_OK) != 0) {
        return 0;
    }
    const struct scene_model *model = load(number);
    rhw_context *context;
    struct scene *scene;
    struct scene_pictures pictures;
    struct scene_view view = scene_view_default(model);
    view.width = WIDTH;
    view.height = HEIGHT;
    view.supersample = 4;
    view.outputs = SCENE_OUTPUT_ALL;
    if (rhw_context_create(def, &context) != RHW_OK || scene_create(context, model, &scene) != RHW_OK ||
        scene_draw(scene, &view, &pictures, NULL) != RHW_OK) {
        fprintf(stderr, "golden: %s cannot be drawn\n", models[number]);
        exit(2);
    }
    uint64_t hash = GOLDEN_HASH_START;
    const void *const planes[] = {pictures.color, pictures.depth, pictures.distance, pictures.object,
                                  pictures.triangle};
    for (int i = 0; i < 5; i++) {
        hash = hash_plane(hash, planes[i], 4);
    }
    const void *const wide[] = {pictures.linear,   pictures.display, pictures.normal,
                                pictures.position, pictures.uv,      pictures.barycentric};
    for (int i = 0; i < 6; i++) {
        hash = hash_plane(hash, wide[i], 16);
    }
    scene_pictures_free(&pictures);
    scene_destroy(scene);
    rhw_context_destroy(context);
    return hash;
}

static const char *model_name(int number)
{
    return models[number];
}

int main(int argc, char **argv)
{
    const struct golden_set set = {sizeof models / sizeof *models, model_name, hash_model};
    const int status = golden_main(&set, argc, argv);
    scene_model_free(loaded);
    return status;
}
