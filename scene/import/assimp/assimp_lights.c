// SPDX-License-Identifier: MIT
// Cameras and lights of what assimp reads. Each has the place of the node of its name.
#include "assimp.h"

#include <math.h>
#include <string.h>
#include <strings.h>

#include "draw/camera/box.h"
#include "elementary.h"
#include "import/builder/numbers.h"

static const double pi = 3.14159265358979324;

// Find the place of the node with this name in the world. Return false where there is none.
static bool find_node(const struct scene_assimp_exact *exact, const struct aiNode *node,
                      const struct aiString *name, const struct scene_import_place *parent,
                      struct scene_import_place *world)
{
    const struct scene_import_place local = scene_assimp_exact_place(exact, node);
    const struct scene_import_place here = scene_import_place_multiply(parent, &local);
    if (strcmp(node->mName.data, name->data) == 0) {
        *world = here;
        return true;
    }
    for (uint32_t i = 0; i < node->mNumChildren; i++) {
        if (node->mChildren[i] != NULL && find_node(exact, node->mChildren[i], name, &here, world)) {
            return true;
        }
    }
    return false;
}

static struct scene_import_place place(const struct scene_assimp_exact *exact, const struct aiScene *scene,
                                       const struct aiString *name)
{
    const struct scene_import_place identity = scene_import_place_identity();
    struct scene_import_place world = identity;
    find_node(exact, scene->mRootNode, name, &identity, &world);
    return world;
}

static void cross(const float a[3], const float b[3], float product[3])
{
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

static bool unit(float vector[3])
{
    const float length =
        __builtin_sqrtf(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
    if (!(length > 1e-20f && length < 1e20f)) {
        return false;
    }
    for (int c = 0; c < 3; c++) {
        vector[c] /= length;
    }
    return true;
}

static void add_camera(struct scene_import *import, const struct scene_assimp_exact *exact,
                       const struct aiScene *scene, const struct aiCamera *source)
{
    struct scene_model_camera camera = {.name = scene_assimp_string(import, &source->mName)};
    float back[3] = {-source->mLookAt.x, -source->mLookAt.y, -source->mLookAt.z};
    float up[3] = {source->mUp.x, source->mUp.y, source->mUp.z}, right[3], local[16];
    const bool seen = unit(back);
    cross(up, back, right);
    const bool upright = unit(right);
    cross(back, right, up);
    scene_import_identity(local);
    memcpy(local, right, sizeof right);
    memcpy(local + 4, up, sizeof up);
    memcpy(local + 8, back, sizeof back);
    memcpy(local + 12, &source->mPosition, sizeof(float[3]));
    const struct scene_import_place node = place(exact, scene, &source->mName);
    const struct scene_import_place own = scene_import_place_of(local);
    const struct scene_import_place world =
        scene_assimp_settled(exact, scene_import_place_multiply(&node, &own), (const double[]){0, 0, 0});
    memcpy(camera.world, world.world, sizeof camera.world);
    // The width of an orthographic camera of Collada stands for an angle, which is marked by its aspect.
    const bool is_marked = source->mAspect < 0 && strcmp(import->model.format, "Collada") == 0;
    const double half_width =
        is_marked ? (double)source->mHorizontalFOV * 180 / pi : (double)source->mOrthographicWidth;
    const double width_aspect = is_marked ? -(double)source->mAspect : (double)source->mAspect;
    // assimp's importers store the whole horizontal angle, whatever its header says.
    const double aspect = width_aspect > 0 ? width_aspect : 4.0 / 3.0;
    camera.aspect = (float)(width_aspect > 0 ? width_aspect : 0);
    camera.yfov = (float)(2 * scene_atan(scene_tan((double)source->mHorizontalFOV / 2) / aspect));
    camera.orthographic = half_width > 0;
    camera.xmag = (float)half_width;
    camera.ymag = (float)(half_width / aspect);
    camera.znear = source->mClipPlaneNear > 0 ? source->mClipPlaneNear : 0.01f;
    camera.zfar = source->mClipPlaneFar > camera.znear ? source->mClipPlaneFar : 0;
    const bool lens = camera.orthographic ? camera.zfar > 0 : camera.yfov > 0 && camera.yfov < 3.14159f;
    if (seen && upright && lens && scene_import_finite(camera.world, 16) &&
        scene_import_determinant(camera.world) != 0) {
        *scene_import_add_camera(import) = camera;
        scene_import_place_camera(import, &world);
    } else {
        scene_import_warn(import, "camera \"%s\" is not valid: left out", camera.name);
    }
}

// Middle of what is drawn, in the world.
static void find_middle(const struct scene_import *import, double middle[3])
{
    const struct scene_model *const model = &import->model;
    struct scene_box box = scene_box_empty();
    for (uint32_t i = 0; i < model->instance_count; i++) {
        const struct scene_mesh *mesh = &model->meshes[model->instances[i].mesh];
        const double *const world = import->exact_instances.matrices[i];
        const double *const moved = import->exact_meshes.matrices[model->instances[i].mesh] + 12;
        for (uint32_t v = 0; v < mesh->vertex_count; v++) {
            double point[3], placed[3];
            for (int c = 0; c < 3; c++) {
                point[c] = moved[c] + (double)mesh->positions[v][c];
            }
            scene_import_transform_exact(world, point, placed);
            scene_box_extend_to(&box, placed);
        }
    }
    for (int c = 0; c < 3; c++) {
        middle[c] = box.low[c] > box.high[c] ? 0 : box.low[c] / 2 + box.high[c] / 2;
    }
}

// The lights of these formats have no physical unit and their own laws of attenuation. What is kept is how
// strongly they light the middle of the model: albedo times colour, no brighter than 1.
static void set_strength(struct scene_model_light *light, const struct aiLight *source, const double place[3],
                         const double middle[3])
{
    float strongest = 0;
    for (int c = 0; c < 3; c++) {
        strongest = light->color[c] > strongest ? light->color[c] : strongest;
    }
    for (int c = 0; c < 3 && strongest > 1; c++) {
        light->color[c] /= strongest;
    }
    light->intensity = (float)pi; // a white surface that faces it reflects 1
    if (light->type == SCENE_LIGHT_DIRECTIONAL) {
        return;
    }
    double square = 0;
    for (int c = 0; c < 3; c++) {
        const double difference = place[c] - middle[c];
        square += difference * difference;
    }
    const double attenuation = (double)source->mAttenuationConstant +
                               (double)source->mAttenuationLinear * sqrt(square) +
                               (double)source->mAttenuationQuadratic * square;
    light->intensity = (float)(pi * square / (attenuation > 1 ? attenuation : 1));
}

// Return whether a name has the address of the light in assimp's memory, which it gives those of X3D that have none. It
// is another one each time.
static bool is_address(const struct scene_import *import, const char *name)
{
    static const char *const kinds[] = {"DirectionalLight_", "PointLight_", "SpotLight_"};
    const char *number = "";
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        const size_t length = strlen(kinds[i]);
        number = strncmp(name, kinds[i], length) == 0 ? name + length : number;
    }
    const size_t least = 7, length = strspn(number, "0123456789");
    return strcasecmp(import->ending, "x3d") == 0 && length >= least && number[length] == 0;
}

static void add_light(struct scene_import *import, const struct scene_assimp_exact *exact,
                      const struct aiScene *scene, const struct aiLight *source, const double middle[3])
{
    struct scene_model_light light = {.name = is_address(import, source->mName.data)
                                                  ? scene_import_string(import, "", 0)
                                                  : scene_assimp_string(import, &source->mName)};
    if (source->mType != aiLightSource_DIRECTIONAL && source->mType != aiLightSource_POINT &&
        source->mType != aiLightSource_SPOT) {
        scene_import_unsupported(import, "ambient and area lights: left out");
        return;
    }
    light.type = source->mType == aiLightSource_DIRECTIONAL ? SCENE_LIGHT_DIRECTIONAL
                 : source->mType == aiLightSource_POINT     ? SCENE_LIGHT_POINT
                                                            : SCENE_LIGHT_SPOT;
    const struct scene_import_place node = place(exact, scene, &source->mName);
    const float *const world = node.world;
    const float position[3] = {source->mPosition.x, source->mPosition.y, source->mPosition.z};
    const float direction[3] = {source->mDirection.x, source->mDirection.y, source->mDirection.z};
    scene_import_transform(world, position, light.position);
    for (int row = 0; row < 3; row++) {
        light.direction[row] =
            world[row] * direction[0] + world[4 + row] * direction[1] + world[8 + row] * direction[2];
    }
    const bool directed = unit(light.direction);
    if (!directed) {
        memcpy(light.direction, (const float[3]){0, 0, -1}, sizeof light.direction);
    }
    light.color[0] = source->mColorDiffuse.r;
    light.color[1] = source->mColorDiffuse.g;
    light.color[2] = source->mColorDiffuse.b;
    // Here the angles are those of the whole cone.
    light.inner_cos = (float)scene_cos((double)source->mAngleInnerCone / 2);
    light.outer_cos = (float)scene_cos((double)source->mAngleOuterCone / 2);
    if (!(light.inner_cos > light.outer_cos)) {
        light.inner_cos = light.outer_cos + 1e-4f;
    }
    struct scene_import_place own = scene_import_place_identity();
    for (int c = 0; c < 3; c++) {
        own.exact[12 + c] = (double)position[c];
    }
    own = scene_import_place_multiply(&node, &own);
    set_strength(&light, source, own.exact + 12, middle);
    const bool good = (directed || light.type == SCENE_LIGHT_POINT) &&
                      scene_import_finite(light.position, 3) && scene_import_finite(light.color, 3) &&
                      scene_import_finite(&light.intensity, 1) &&
                      light.color[0] + light.color[1] + light.color[2] > 0 && light.intensity > 0;
    if (good) {
        *scene_import_add_light(import) = light;
        scene_import_place_light(import, &own);
    } else {
        scene_import_warn(import, "light \"%s\" gives no light: left out", light.name);
    }
}

void scene_assimp_add_cameras(struct scene_import *import, const struct scene_assimp_exact *exact,
                              const struct aiScene *scene)
{
    for (uint32_t i = 0; i < scene->mNumCameras; i++) {
        add_camera(import, exact, scene, scene->mCameras[i]);
    }
}

void scene_assimp_add_lights(struct scene_import *import, const struct scene_assimp_exact *exact,
                             const struct aiScene *scene)
{
    double middle[3];
    if (scene->mNumLights > 0) {
        find_middle(import, middle);
    }
    for (uint32_t i = 0; i < scene->mNumLights; i++) {
        add_light(import, exact, scene, scene->mLights[i], middle);
    }
}
