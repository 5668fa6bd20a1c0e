// SPDX-License-Identifier: MIT
// Models that stand millions of times their size away from the origin of their file. Each is read once more at the
// origin, and both must be one shape.
#include "model_files.h"

#include "draw/camera/camera.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CORNERS = 5, FACES = 6 };

// Floats have all digits of the shape at the origin, and at `far` none that tell one corner from another.
static const double shape[CORNERS][3] = {
    {0, 0, 0}, {0.8125, 0.125, 0}, {0.25, 0.9375, 0.0625}, {0.125, 0.25, 0.71875}, {0.375, 0.5, -0.5}};
static const int faces[FACES][3] = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
static const double near[3] = {0, 0, 0}, far[3] = {54598150.375, -43210987.25, 12345678.625};

typedef void write_function(const double place[3]);

// What is drawn of a vertex, in the coordinates of the file.
static void find_vertex(const struct scene_model *model, uint32_t instance, uint32_t vertex, double point[3])
{
    const float *const world = model->instances[instance].world;
    const float *const p = model->meshes[model->instances[instance].mesh].positions[vertex];
    for (int c = 0; c < 3; c++) {
        assert_true(fabsf(p[c]) < 16.0f && fabsf(world[12 + c]) < 16.0f); // so that floats are dense
        point[c] = (double)world[c] * (double)p[0] + (double)world[4 + c] * (double)p[1] +
                   (double)world[8 + c] * (double)p[2] + (double)world[12 + c] + model->origin[c];
    }
}

static void assert_one_shape(const char *name, write_function *write)
{
    write(near);
    struct scene_model *const here = load(name);
    write(far);
    struct scene_model *const there = load(name);
    assert_false(scene_origin_is_far(here->origin));
    assert_true(scene_origin_is_far(there->origin));
    assert_int_equal(here->instance_count, there->instance_count);
    for (uint32_t i = 0; i < here->instance_count; i++) {
        const struct scene_mesh *const a = &here->meshes[here->instances[i].mesh],
                                       *const b = &there->meshes[there->instances[i].mesh];
        assert_int_equal(a->vertex_count, b->vertex_count);
        for (uint32_t v = 0; v < a->vertex_count; v++) {
            double p[3], q[3];
            find_vertex(here, i, v, p);
            find_vertex(there, i, v, q);
            for (int c = 0; c < 3; c++) {
                assert_true(fabs(q[c] - far[c] - p[c]) < 1e-6);
            }
            if (a->normals != NULL) {
                assert_floats(b->normals[v], a->normals[v], 3, 1e-6f);
            }
        }
    }
    scene_model_free(here);
    scene_model_free(there);
}

// Text formats --------------------------------------------------------------------------------------

static char text[8192];

static void append(const char *format, ...) __attribute__((format(printf, 1, 2)));

static void append(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const size_t length = strlen(text);
    vsnprintf(text + length, sizeof text - length, format, arguments);
    va_end(arguments);
}

// With a pair, the text formats have the shape a second time in the same mesh, at `far`.
static bool is_pair;

static int shapes(void)
{
    return is_pair ? 2 : 1;
}

static void append_corner(const char *before, const double place[3], int corner)
{
    const double *const p = shape[corner];
    append("%s%.9f %.9f %.9f\n", before, place[0] + p[0], place[1] + p[1], place[2] + p[2]);
}

static void append_corners(const char *before, const double place[3])
{
    for (int i = 0; i < CORNERS * shapes(); i++) {
        append_corner(before, i < CORNERS ? place : far, i % CORNERS);
    }
}

static void append_faces(const char *before, int first)
{
    for (int i = 0; i < FACES * shapes(); i++) {
        const int *const face = faces[i % FACES], k = first + CORNERS * (i / FACES);
        append("%s %d %d %d\n", before, face[0] + k, face[1] + k, face[2] + k);
    }
}

// The vertex at 0 is in no face.
static void write_obj(const double place[3])
{
    strcpy(text, "v 0 0 0\n");
    append_corners("v ", place);
    append_faces("f", 2);
    write_text("x.obj", text);
}

static void write_ply(const double place[3])
{
    text[0] = 0;
    append("ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double y\n"
           "property double z\nelement face %d\nproperty list uchar int vertex_indices\nend_header\n",
           CORNERS * shapes(), FACES * shapes());
    append_corners("", place);
    append_faces("3", 0);
    write_text("x.ply", text);
}

// Two of the facets have a normal, so that those of the others are made.
static void write_stl(const double place[3])
{
    strcpy(text, "solid a\n");
    for (int i = 0; i < FACES * shapes(); i++) {
        append("facet normal 0 0 %d\nouter loop\n", i % FACES < 2);
        for (int k = 0; k < 3; k++) {
            append_corner("vertex ", i < FACES ? place : far, faces[i % FACES][k]);
        }
        append("endloop\nendfacet\n");
    }
    append("endsolid a\n");
    write_text("x.stl", text);
}

static void write_off(const double place[3])
{
    text[0] = 0;
    append("OFF\n%d %d 0\n", CORNERS * shapes(), FACES * shapes());
    append_corners("", place);
    append_faces("3", 0);
    write_text("x.off", text);
}

static void write_xyz(const double place[3])
{
    text[0] = 0;
    append_corners("", place);
    write_text("x.xyz", text);
}

// Writes a Collada document with the shape at `inside` of its mesh, and `place` before it in its node.
static void write_dae(const double inside[3], const char *place)
{
    strcpy(text,
           "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
           "version=\"1.4.1\"><asset><up_axis>Y_UP"
           "</up_axis></asset><library_geometries><geometry id=\"m\"><mesh><source id=\"p\"><float_array "
           "id=\"a\" count=\"15\">");
    for (int i = 0; i < CORNERS; i++) {
        append_corner(" ", inside, i);
    }
    append(
        "</float_array><technique_common><accessor source=\"#a\" count=\"5\" stride=\"3\"><param name=\"X\" "
        "type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor>"
        "</technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" "
        "source=\"#p\"/></vertices>"
        "<triangles count=\"6\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>");
    for (int i = 0; i < FACES; i++) {
        append("%d %d %d ", faces[i][0], faces[i][1], faces[i][2]);
    }
    append("</p></triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene "
           "id=\"s\">"
           "<node>%s<instance_geometry url=\"#m\"/></node></visual_scene>"
           "</library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>",
           place);
    write_text("x.dae", text);
}

static void write_dae_node(const double place[3])
{
    char translate[128];
    snprintf(translate, sizeof translate, "<translate>%.9f %.9f %.9f</translate>", place[0], place[1],
             place[2]);
    write_dae(near, translate);
}

static void write_dae_vertices(const double place[3])
{
    write_dae(place, "");
}

// Writes an FBX of text, with the shape at `inside` of its geometry.
static void write_fbx(const double inside[3], const double place[3])
{
    strcpy(
        text,
        "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7400\n}\n"
        "Objects:  {\n\tGeometry: 10, \"Geometry::g\", \"Mesh\" {\n\t\tVertices: *15 {\n\t\t\ta: ");
    for (int i = 0; i < CORNERS; i++) {
        const double *const p = shape[i];
        append("%s%.9f,%.9f,%.9f", i > 0 ? "," : "", inside[0] + p[0], inside[1] + p[1], inside[2] + p[2]);
    }
    append("\n\t\t}\n\t\tPolygonVertexIndex: *18 {\n\t\t\ta: ");
    for (int i = 0; i < FACES; i++) {
        append("%s%d,%d,%d", i > 0 ? "," : "", faces[i][0], faces[i][1], -1 - faces[i][2]);
    }
    append("\n\t\t}\n\t\tGeometryVersion: 124\n\t}\n\tModel: 11, \"Model::m\", \"Mesh\" {\n\t\tVersion: 232\n"
           "\t\tProperties70:  {\n\t\t\tP: \"Lcl Translation\", \"Lcl Translation\", \"\", "
           "\"A\",%.9f,%.9f,%.9f\n"
           "\t\t}\n\t}\n}\nConnections:  {\n\tC: \"OO\",11,0\n\tC: \"OO\",10,11\n}\n",
           place[0], place[1], place[2]);
    write_text("x.fbx", text);
}

static void write_fbx_node(const double place[3])
{
    write_fbx(near, place);
}

static void write_fbx_vertices(const double place[3])
{
    write_fbx(place, near);
}

static void test_text_formats(void **state)
{
    (void)state;
    assert_one_shape("x.obj", write_obj);
    assert_one_shape("x.ply", write_ply);
    assert_one_shape("x.stl", write_stl);
    assert_one_shape("x.off", write_off);
    assert_one_shape("x.xyz", write_xyz);
}

static void test_assimp(void **state)
{
    (void)state;
    assert_one_shape("x.dae", write_dae_node);
    assert_one_shape("x.dae", write_dae_vertices);
    assert_one_shape("x.fbx", write_fbx_node);
    assert_one_shape("x.fbx", write_fbx_vertices);
}

// assimp keeps floats, of which those of other formats are not put right: what they may have lost is told.
static void test_floats_of_assimp(void **state)
{
    (void)state;
    write_dae(near, "");
    struct scene_model *model = load("x.dae");
    assert_int_equal(model->warning_count, 0);
    scene_model_free(model);
    strcpy(text, "xof 0303txt 0032\nMesh {\n5;\n");
    for (int i = 0; i < CORNERS; i++) {
        append("%.6f;%.6f;%.6f;%s\n", 500000 + shape[i][0], shape[i][1], shape[i][2],
               i + 1 < CORNERS ? "," : ";");
    }
    append("1;\n3;0,1,3;;\n}\n");
    model = load_text("x.x", text);
    assert_true(has_warning(model, "places are up to 0.031 apart"));
    scene_model_free(model);
}

// glTF ----------------------------------------------------------------------------------------------

// Writes the shape, at `inside` of its mesh, under `nodes`; `more` are members of the file, and `views` follow the
// shape's two in `extra`.
static void write_shape(const char *nodes, const char *more, const double inside[3], const float (*extra)[4])
{
    struct {
        float positions[CORNERS][3], extra[CORNERS][4];
        uint16_t indices[3 * FACES];
    } bytes = {0};
    for (int i = 0; i < CORNERS; i++) {
        for (int c = 0; c < 3; c++) {
            bytes.positions[i][c] = (float)(shape[i][c] + inside[c]);
        }
    }
    if (extra != NULL) {
        memcpy(bytes.extra, extra, sizeof bytes.extra);
    }
    for (int i = 0; i < 3 * FACES; i++) {
        bytes.indices[i] = (uint16_t)faces[i / 3][i % 3];
    }
    write_format(
        "x.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],%s,\"nodes\":[%s],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":5,\"type\":\"VEC3\"},"
        "{\"bufferView\":2,\"componentType\":5123,\"count\":18,\"type\":\"SCALAR\"},"
        "{\"bufferView\":1,\"componentType\":5126,\"count\":5,\"type\":\"VEC4\"},"
        "{\"bufferView\":1,\"componentType\":5126,\"count\":1,\"type\":\"VEC3\"},"
        "{\"componentType\":5121,\"count\":5,\"type\":\"VEC4\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":60},{\"buffer\":0,\"byteOffset\":60,"
        "\"byteLength\":80},{\"buffer\":0,\"byteOffset\":140,\"byteLength\":36}],"
        "\"buffers\":[{\"byteLength\":176,\"uri\":\"%s\"}]}",
        more, nodes, data_uri(&bytes, sizeof bytes));
}

#define MESH "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}]"

// A child that is far within its parent, which stands on its head: a turn about x takes y to −y and z to −z.
static void write_children(const double place[3])
{
    char nodes[512];
    snprintf(nodes, sizeof nodes,
             "{\"children\":[1],\"rotation\":[1,0,0,0],\"translation\":[1,2,3]},{\"mesh\":0,\"rotation\":[1,"
             "0,0,0],"
             "\"translation\":[%.9f,%.9f,%.9f]}",
             place[0] - 1, 2 - place[1], 3 - place[2]);
    write_shape(nodes, MESH, near, NULL);
}

static void write_matrix(const double place[3])
{
    char nodes[512];
    snprintf(nodes, sizeof nodes, "{\"mesh\":0,\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,%.9f,%.9f,%.9f,1]}",
             place[0], place[1], place[2]);
    write_shape(nodes, MESH, near, NULL);
}

// EXT_mesh_gpu_instancing; a float has multiples of 4 of the place, the node has the rest.
static void write_many(const double place[3])
{
    char nodes[512];
    float moves[CORNERS][4] = {0};
    for (int c = 0; c < 3; c++) {
        moves[0][c] = (float)place[c];
    }
    snprintf(nodes, sizeof nodes,
             "{\"mesh\":0,\"translation\":[%.9f,%.9f,%.9f],\"extensions\":{\"EXT_mesh_gpu_instancing\":"
             "{\"attributes\":{\"TRANSLATION\":3}}}}",
             place[0] - (double)moves[0][0], place[1] - (double)moves[0][1], place[2] - (double)moves[0][2]);
    write_shape(nodes, MESH ",\"extensionsUsed\":[\"EXT_mesh_gpu_instancing\"]", near,
                (const float(*)[4])moves);
}

// Every vertex follows the one joint.
static void write_skin(const double place[3])
{
    char nodes[512];
    const float weights[CORNERS][4] = {{1}, {1}, {1}, {1}, {1}};
    snprintf(nodes, sizeof nodes,
             "{\"mesh\":0,\"skin\":0,\"children\":[1]},{\"translation\":[%.9f,%.9f,%.9f]}", place[0],
             place[1], place[2]);
    write_shape(nodes,
                "\"skins\":[{\"joints\":[1]}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,"
                "\"JOINTS_0\":4,\"WEIGHTS_0\":2},\"indices\":1}]}]",
                near, weights);
}

static void test_gltf(void **state)
{
    (void)state;
    assert_one_shape("x.gltf", write_children);
    assert_one_shape("x.gltf", write_matrix);
    assert_one_shape("x.gltf", write_many);
    assert_one_shape("x.gltf", write_skin);
}

// Two nodes so far from each other that floats lose the size of each in its bounds.
static void test_nodes_far_from_each_other(void **state)
{
    (void)state;
    static const double steps[] = {3e6, 2e7, 5e8, 4e11};
    for (int i = 0; i < 4; i++) {
        const double place[3] = {steps[i], -0.75 * steps[i], 0.5 * steps[i]};
        char nodes[512];
        snprintf(nodes, sizeof nodes,
                 "{\"children\":[1,2]},{\"mesh\":0},{\"mesh\":0,\"translation\":[%.1f,%.1f,%.1f]}", place[0],
                 place[1], place[2]);
        write_shape(nodes, MESH, near, NULL);
        struct scene_model *const model = load("x.gltf");
        assert_int_equal(model->instance_count, 2);
        assert_true(model->is_scattered && model->warning_count == 0);
        for (int c = 0; c < 3; c++) {
            assert_true(model->instances[1].place[c] - model->instances[0].place[c] == place[c]);
        }
        scene_model_free(model);
    }
}

// Positions that are far in the mesh and brought back by its node, as far as floats have them.
static void test_brought_back(void **state)
{
    (void)state;
    const double inside[3] = {65536, -32768, 131072};
    write_shape("{\"mesh\":0,\"translation\":[-65536,32768,-131072]}", MESH, inside, NULL);
    struct scene_model *model = load("x.gltf");
    assert_false(scene_origin_is_far(model->origin));
    double point[3];
    find_vertex(model, 0, 1, point);
    assert_true(fabs(point[0] - 0.8125) < 1e-6 && fabs(point[1] - 0.125) < 1e-6 && fabs(point[2]) < 1e-6);
    scene_model_free(model);
}

static void test_camera_and_light(void **state)
{
    (void)state;
    char nodes[512];
    snprintf(
        nodes, sizeof nodes,
        "{\"children\":[1,2,3],\"translation\":[%.9f,%.9f,%.9f]},{\"mesh\":0},{\"camera\":0,\"translation\":"
        "[0.25,0.5,4]},{\"translation\":[1,2,3],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}",
        far[0], far[1], far[2]);
    write_shape(nodes,
                MESH ",\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.5,\"znear\":0.1}}],"
                     "\"extensionsUsed\":[\"KHR_lights_punctual\"],\"extensions\":{\"KHR_lights_punctual\":"
                     "{\"lights\":[{\"type\":\"point\"}]}}",
                near, NULL);
    struct scene_model *model = load("x.gltf");
    const struct scene_camera camera = scene_camera_from_model(model, &model->cameras[0], 1.0);
    const double eye[3] = {0.25, 0.5, 4}, light[3] = {1, 2, 3};
    for (int c = 0; c < 3; c++) {
        assert_true(camera.eye[c] == far[c] + eye[c]);
        assert_true(model->origin[c] + (double)model->lights[0].position[c] == far[c] + light[c]);
    }
    scene_model_free(model);
}

// A mesh of floats with two shapes: no more is lost than floats lost, also where a turned node stands far away.
static void test_floats_of_a_mesh(void **state)
{
    (void)state;
    struct {
        float positions[2 * CORNERS][3];
        uint16_t indices[2 * 3 * FACES];
    } bytes;
    static const float apart = 524288;
    for (int i = 0; i < 2 * CORNERS; i++) {
        for (int c = 0; c < 3; c++) {
            bytes.positions[i][c] = (float)shape[i % CORNERS][c] + (i < CORNERS || c > 0 ? 0 : apart);
        }
    }
    for (int i = 0; i < 2 * 3 * FACES; i++) {
        const int k = i % (3 * FACES);
        bytes.indices[i] = (uint16_t)(faces[k / 3][k % 3] + (i == k ? 0 : CORNERS));
    }
    write_format("x.gltf",
                 "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}]," MESH
                 ",\"nodes\":[{\"mesh\":0},{\"mesh\":0,\"rotation\":[1,0,0,0],\"translation\":[0,3e9,0]}],"
                 "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":10,\"type\":\"VEC3\"},"
                 "{\"bufferView\":1,\"componentType\":5123,\"count\":36,\"type\":\"SCALAR\"}],"
                 "\"bufferViews\":[{\"buffer\":0,\"byteLength\":120},{\"buffer\":0,\"byteOffset\":120,"
                 "\"byteLength\":72}],\"buffers\":[{\"byteLength\":192,\"uri\":\"%s\"}]}",
                 data_uri(&bytes, sizeof bytes));
    struct scene_model *const model = load("x.gltf");
    assert_int_equal(model->instance_count, 4);
    assert_int_equal(model->warning_count, 0);
    for (int i = 0; i < 4; i++) {
        const struct scene_instance *const instance = &model->instances[i];
        const float *const p = model->meshes[instance->mesh].positions[0];
        const double first[3] = {i < 2 ? 0 : (double)apart, i % 2 == 0 ? 0 : 3e9, 0};
        for (int c = 0; c < 3; c++) {
            const double turned = c > 0 && i % 2 == 1 ? -1 : 1;
            assert_true(model->origin[c] + instance->place[c] + turned * (double)p[c] == first[c]);
        }
    }
    scene_model_free(model);
}

// Two parts that are far apart have an origin each, also in one mesh of the file.
static void test_clusters(void **state)
{
    (void)state;
    static const double places[2][3] = {{0, 0, 0}, {54598150.375, -43210987.25, 12345678.625}};
    for (int is_apart = 0; is_apart < 2; is_apart++) {
        char lines[2048];
        int length = 0;
        for (int k = 0; k < 2; k++) {
            for (int i = 0; i < CORNERS; i++) {
                length += sprintf(lines + length, "v %.17g %.17g %.17g\n", places[k][0] + shape[i][0],
                                  places[k][1] + shape[i][1], places[k][2] + shape[i][2]);
            }
        }
        for (int k = 0; k < 2; k++) {
            length += is_apart ? sprintf(lines + length, "o part%d\n", k) : 0;
            for (int i = 0; i < FACES; i++) {
                const int first = 1 + CORNERS * k;
                length += sprintf(lines + length, "f %d %d %d\n", faces[i][0] + first, faces[i][1] + first,
                                  faces[i][2] + first);
            }
        }
        write_text("x.obj", lines);
        struct scene_model *const model = load("x.obj");
        assert_int_equal(model->instance_count, 2);
        assert_true(model->is_scattered && model->warning_count == 0);
        const struct scene_mesh *const meshes[2] = {&model->meshes[model->instances[0].mesh],
                                                    &model->meshes[model->instances[1].mesh]};
        assert_int_equal(meshes[0]->vertex_count, meshes[1]->vertex_count);
        for (uint32_t v = 0; v < meshes[0]->vertex_count; v++) {
            for (int c = 0; c < 3; c++) {
                double apart = places[1][c];
                apart -= model->instances[1].place[c] + (double)meshes[1]->positions[v][c];
                apart += model->instances[0].place[c] + (double)meshes[0]->positions[v][c];
                assert_true(fabs(apart) < 1e-6);
            }
        }
        scene_model_free(model);
    }
}

// The faces of many groups stand in one part, those of all groups in turn, and are sorted by where they are. What ends
// as one group begins as two: it has two small faces far from each other, until a large one comes.
static void test_many_clusters(void **state)
{
    (void)state;
    enum { GROUPS = 30, EACH = 3 };
    static const int places[EACH] = {0, 2000, 0}, sizes[EACH] = {1, 1, 1900};
    static char lines[GROUPS * EACH * 128];
    int length = 0;
    for (int i = 0; i < GROUPS * EACH; i++) {
        const int x = i % GROUPS * 10000000 + places[i / GROUPS], size = sizes[i / GROUPS];
        length += sprintf(lines + length, "v %d 0 0\nv %d 0 0\nv %d 0 1\nf -3 -2 -1\n", x, x + size, x);
    }
    write_text("x.obj", lines);
    struct scene_model *const model = load("x.obj");
    assert_int_equal(model->instance_count, GROUPS);
    bool found[GROUPS] = {false};
    double first = 0;
    for (uint32_t i = 0; i < GROUPS; i++) {
        const struct scene_instance *const instance = &model->instances[i];
        const struct scene_mesh *const mesh = &model->meshes[instance->mesh];
        const double x = instance->place[0] + (double)mesh->positions[mesh->indices[0]][0];
        first = i == 0 ? x : first;
        const int group = (int)((x - first) / 1e7);
        assert_in_range(group, 0, GROUPS - 1);
        assert_true(x - first == 1e7 * group && !found[group]);
        found[group] = true;
        assert_int_equal(mesh->index_count, 3 * EACH);
        assert_true(mesh->bounds_max[0] - mesh->bounds_min[0] == 2001);
    }
    scene_model_free(model);
}

// Two shapes of one mesh that are far from each other: both are the one that a file has alone.
static void assert_pair(const char *name, write_function *write)
{
    is_pair = false;
    write(near);
    struct scene_model *const one = load(name);
    is_pair = true;
    write(near);
    struct scene_model *const two = load(name);
    is_pair = false;
    assert_true(two->is_scattered && two->warning_count == 0);
    assert_int_equal(two->instance_count, 2);
    const struct scene_mesh *const mesh = &one->meshes[one->instances[0].mesh];
    for (int i = 0; i < 2; i++) {
        const struct scene_instance *const instance = &two->instances[i];
        const struct scene_mesh *const piece = &two->meshes[instance->mesh];
        const double *const place = i == 0 ? near : far;
        assert_int_equal(instance->object, one->instances[0].object);
        assert_int_equal(piece->vertex_count, mesh->vertex_count);
        assert_int_equal(piece->index_count, mesh->index_count);
        assert_memory_equal(piece->indices, mesh->indices, mesh->index_count * sizeof *mesh->indices);
        for (uint32_t v = 0; v < mesh->vertex_count; v++) {
            for (int c = 0; c < 3; c++) {
                const double there = two->origin[c] + instance->place[c] + (double)piece->positions[v][c];
                assert_true(fabs(there - place[c] - (double)mesh->positions[v][c]) < 1e-6);
            }
            if (mesh->normals != NULL) {
                assert_floats(piece->normals[v], mesh->normals[v], 3, 1e-6f);
            }
        }
    }
    scene_model_free(one);
    scene_model_free(two);
}

static void test_pairs(void **state)
{
    (void)state;
    assert_pair("x.obj", write_obj);
    assert_pair("x.ply", write_ply);
    assert_pair("x.stl", write_stl);
    assert_pair("x.off", write_off);
    assert_pair("x.xyz", write_xyz);
}

// A polygon with a notch in the far part of a mesh: its ears are found there as they are here.
static void test_polygon_of_part(void **state)
{
    (void)state;
    static const int arrow[4][2] = {{0, 0}, {4, 1}, {1, 1}, {1, 4}};
    for (int is_off = 0; is_off < 2; is_off++) {
        text[0] = 0;
        append(is_off
                   ? "OFF\n8 2 0\n"
                   : "ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\nproperty double y\n"
                     "property double z\nelement face 2\nproperty list uchar int vertex_index\nend_header\n");
        for (int i = 0; i < 8; i++) {
            append("%.3f %.3f 0\n", 0.25 * arrow[i % 4][0] + i / 4 * 54598150.375, 0.25 * arrow[i % 4][1]);
        }
        append("4 1 2 3 0\n4 5 6 7 4\n");
        write_text("x.any", text);
        struct scene_model *const model = load("x.any");
        assert_int_equal(model->instance_count, 2);
        const struct scene_mesh *const a = &model->meshes[model->instances[0].mesh],
                                       *const b = &model->meshes[model->instances[1].mesh];
        assert_int_equal(a->index_count, 6);
        assert_memory_equal(a->indices, b->indices, 6 * sizeof *a->indices);
        scene_model_free(model);
    }
}

// Parts of what is one thing: they are far from each other as points, and faces or nearness hold them together.
static void test_one_mesh(void **state)
{
    (void)state;
    static const char *const files[] = {
        // the corners of a cube, and those of a large triangle beside a small one
        "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n",
        "OFF\n6 2 0\n0 0 0\n1e7 0 0\n0 1e7 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 3 4 5\n",
        // near by the size of the larger one
        "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n1000 0 0\n1000.1 0 0\n1000 0.1 0\n3 0 1 2\n3 3 4 5\n",
        // a point far from a cloud has no size
        "0 0 0\n1 0 0\n0 1 0\n1 1 0\n1e8 0 0\n"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        const char *const name = files[i][0] == 'O' ? "x.off" : "x.xyz";
        write_text(name, files[i]);
        struct scene_model *const model = load(name);
        assert_int_equal(model->mesh_count, 1);
        assert_int_equal(model->instance_count, 1);
        scene_model_free(model);
    }
}

// Elements with a corner without a place are left out, also where their other corners are far from each other.
static void test_corners_without_a_place(void **state)
{
    (void)state;
    struct scene_model *const model = load_text(
        "n.off", "OFF\n11 6 0\n0 0 0\n1 0 0\n0 1 0\n10000000 0 0\n10000001 0 0\n10000000 1 0\n20000000 0 0\n"
                 "20000001 0 0\n30000000 0 0\n30000001 0 0\nnan nan nan\n3 0 1 2\n3 3 4 5\n2 10 6\n2 10 7\n"
                 "2 10 8\n2 10 9\n");
    assert_int_equal(model->triangles_drawn, 2);
    assert_true(has_warning(model, "primitives with positions that are not finite are left out"));
    scene_model_free(model);
}

// 256 times its size away and less, a model has the numbers of its file.
static void test_how_far(void **state)
{
    (void)state;
    write_text("x.obj", "v 250 0 0\nv 251 0 0\nv 250 1 0\nv 251 1 0\nf 1 2 3\nf 2 4 3");
    struct scene_model *model = load("x.obj");
    assert_false(scene_origin_is_far(model->origin));
    assert_true(model->bounds_max[0] == 251.0f);
    scene_model_free(model);
    write_text("x.obj", "v 260 0 0\nv 261 0 0\nv 260 1 0\nv 261 1 0\nf 1 2 3\nf 2 4 3");
    model = load("x.obj");
    assert_true(model->origin[0] > 256 && model->origin[1] <= 1);
    assert_true((double)model->bounds_max[0] + model->origin[0] == 261);
    scene_model_free(model);
    write_text("x.obj", "v 1e7 2e7 0\np 1\n"); // a point has no size
    model = load("x.obj");
    assert_false(scene_origin_is_far(model->origin));
    scene_model_free(model);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_corners_without_a_place),
    cmocka_unit_test(test_text_formats),
    cmocka_unit_test(test_assimp),
    cmocka_unit_test(test_floats_of_assimp),
    cmocka_unit_test(test_gltf),
    cmocka_unit_test(test_nodes_far_from_each_other),
    cmocka_unit_test(test_brought_back),
    cmocka_unit_test(test_camera_and_light),
    cmocka_unit_test(test_clusters),
    cmocka_unit_test(test_pairs),
    cmocka_unit_test(test_many_clusters),
    cmocka_unit_test(test_how_far),
    cmocka_unit_test(test_polygon_of_part),
    cmocka_unit_test(test_one_mesh),
    cmocka_unit_test(test_floats_of_a_mesh),
};

const struct unit_tests test_origin = UNIT_TESTS(tests, make_directory, remove_directory);
