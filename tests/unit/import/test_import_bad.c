// SPDX-License-Identifier: MIT
// Files that are no models, or hostile ones: one line that names the cause, and nothing worse.
#include "model_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#define LFS                                                   \
    "version https://git-lfs.github.com/spec/v1\noid sha256:" \
    "0000000000000000000000000000000000000000000000000000000000000000\nsize 123456\n"

static const struct {
    const char *name, *text, *cause;
} bad_files[] = {
    {"empty.gltf", "", "the file is empty"},
    {"words.gltf", "this is no JSON", "is not valid JSON: line 1"},
    {"open.gltf", "{\"asset\":{\"version\":\"2.0\"}", "is not valid JSON"},
    {"array.gltf", "[1,2,3]", "not an object"},
    {"nothing.gltf", "{}", "no asset version"},
    {"old.gltf", "{\"asset\":{\"version\":\"1.0\"}}", "is glTF 1.0, which is not supported"},
    {"older.gltf", "{\"asset\":{\"version\":1.0}}", "is glTF 1.0, which is not supported"},
    {"new.gltf", "{\"asset\":{\"version\":\"2.1\",\"minVersion\":\"2.1\"}}", "at least glTF 2.1"},
    {"splats.ply",
     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
     "property float f_dc_0\nproperty float opacity\nproperty float scale_0\nproperty float "
     "rot_0\nend_header\n"
     "0 0 0 1 1 1 1\n",
     "holds Gaussian splats, which are not supported"},
    {"packed.ply",
     "ply\nformat ascii 1.0\nelement vertex 1\nproperty uint packed_position\nproperty uint packed_rotation\n"
     "property uint packed_scale\nproperty uint packed_color\nend_header\n1 1 1 1\n",
     "holds Gaussian splats, which are not supported"},
    {"voxels.gltf", "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"EXT_primitive_voxels\"]}",
     "requires the glTF extension EXT_primitive_voxels"},
    {"cycle.gltf", "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"children\":[1]},{\"children\":[0]}]}",
     "the node graph has a cycle"},
    {"self.gltf", "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"children\":[0]}]}",
     "the node graph has a cycle"},
    {"child.gltf", "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"children\":[7]}]}",
     "a node that does not exist"},
    {"mesh.gltf", "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":3}]}", "meshes[3], but there are 0"},
    {"types.gltf", "{\"asset\":{\"version\":\"2.0\"},\"nodes\":{}}", "\"nodes\" must be an array"},
    {"null.gltf", "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[null]}", "nodes[0] must be an object"},
    {"matrix.gltf", "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"matrix\":[1,2]}]}",
     "\"matrix\" must have 16 numbers"},
    {"count.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
     "{\"POSITION\":0}}]}],"
     "\"accessors\":[{\"componentType\":5126,\"type\":\"VEC3\",\"count\":4000000000}]}",
     "has 4000000000 elements and no data"},
    {"most.gltf",
     "{\"asset\":{\"version\":2},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
     "{\"POSITION\":0}}]}],"
     "\"accessors\":[{\"componentType\":5126,\"type\":\"VEC3\",\"count\":9007199254740992}]}",
     "accessors[0]: its count must be 1 to 4294967294"},
    {"beyond.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
     "{\"POSITION\":0}}]}],"
     "\"accessors\":[{\"componentType\":5126,\"type\":\"VEC3\",\"count\":9e16}]}",
     "\"count\" must be a whole number, 0 to 9007199254740992"},
    {"past.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
     "{\"POSITION\":0}}]}],"
     "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":2}],"
     "\"bufferViews\":[{\"buffer\":0,\"byteLength\":12}],\"buffers\":[{\"byteLength\":12,\"uri\":\"data:;"
     "base64,AAAAAAAAAAAAAAAA\"}]}",
     "accessors[0] reaches past the end of bufferViews[0]"},
    {"view.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
     "{\"POSITION\":0}}]}],"
     "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":1}],"
     "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":9007199254740992,\"byteLength\":12}],"
     "\"buffers\":[{\"byteLength\":12,\"uri\":\"data:;base64,AAAAAAAAAAAAAAAA\"}]}",
     "bufferViews[0] reaches past the end"},
    {"index.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
     "{\"POSITION\":0},\"indices\":1}]}],"
     "\"accessors\":[{\"componentType\":5126,\"type\":\"VEC3\",\"count\":2},{\"bufferView\":0,"
     "\"componentType\":5121,\"type\":\"SCALAR\",\"count\":3}],"
     "\"bufferViews\":[{\"buffer\":0,\"byteLength\":3}],\"buffers\":[{\"byteLength\":3,\"uri\":\"data:;"
     "base64,AAEJ\"}]}",
     "index 9 is outside its 2 vertices"},
    {"bin.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
     "{\"POSITION\":0}}]}],"
     "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":1}],"
     "\"bufferViews\":[{\"buffer\":0,\"byteLength\":12}],\"buffers\":[{\"byteLength\":12,\"uri\":\"gone\\n."
     "bin\"}]}",
     "\"gone?.bin\": No such file"},
    {"short.glb", "glTF\2", "truncated"},
    {"far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "vertex 4 of 3"},
    {"back.obj", "v 0 0 0\nf -1 -2 -3\n", "line 2: an index reaches back"},
    {"huge.obj", "v 0 0 0\nf 1 1 99999999999999999999\n", "of 1"},
    {"junk.obj", "hello\n", "has no vertices"},
    {"count.ply",
     "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float "
     "z\nend_header\n0 0 0\n",
     "is truncated"},
    {"magic.ply", "plx\nformat ascii 1.0\n", "does not begin with \"ply\""},
    {"endless.ply", "ply\nformat ascii 1.0\n", "no end_header"},
    {"index.ply",
     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
     "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n3 0 0 -1\n",
     "face 0 refers to vertex -1 of 1"},
    {"text.xyzzy", "not a model\n", "is not a model in a format that can be read"},
    {"solid.stl", "solid", "is no STL model: it has no facets"},
    {"part.step", "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\n",
     "is STEP (CAD), which"},
    {"part.ifc", "ISO-10303-21;\nHEADER;\nFILE_SCHEMA (('CONFIG_CONTROL_DESIGN'));\n",
     "is STEP (CAD), which"},
    {"part", "\xef\xbb\xbf\nISO-10303-21;\nHEADER;\n", "is STEP (CAD), which"},
    {"part.stp", "something else", "is STEP (CAD), which"},
    {"box.wrl", "#VRML V2.0 utf8\nShape { geometry Box { } }\n", "is VRML, which is not supported"},
    {"box.obj", "#VRML V1.0 ascii\n", "is VRML 1.0, which is not supported"},
    {"box.x3dv", "#X3D V3.0 utf8\n", "is X3D (classic VRML), which"},
    {"new.blend", "\x28\xb5\x2f\xfd data",
     "is a Blender file of 3.0 or later (zstd), which is not supported"},
    {"new", "\x28\xb5\x2f\xfd data", "is a Blender file of 3.0 or later (zstd), which"},
    {"new.blend1", "\x28\xb5\x2f\xfd data", "is a Blender file of 3.0 or later (zstd), which"},
    {"new.obj", "\x28\xb5\x2f\xfd data", "is compressed by zstd, which is not supported"},
    {"a.obj.gz", "\x1f\x8b data", "is compressed by gzip, which is to be unpacked first"},
    {"a.tgz", "\x1f\x8b data", "is compressed by gzip, which is to be unpacked first"},
    {"old.blend", "\x1f\x8b data", "cannot be read: "},
    {"a.obj.bz2", "BZh91AY", "is compressed by bzip2, which is to be unpacked first"},
    {"a.stl.xz",
     "\xfd"
     "7zXZ",
     "is compressed by xz, which is to be unpacked first"},
    {"a.7z", "7z\xbc\xaf\x27\x1c", "is a 7-Zip archive, which is to be unpacked first"},
    {"a.rar", "Rar!\x1a\7\1", "is a RAR archive, which is to be unpacked first"},
    {"a.zip", "PK\3\4 f 0 1 2", "is a ZIP archive, which is to be unpacked first"},
    {"later.blend", "BLENDER_v293RENDH", "is a Blender file of version 2.93, which is not supported"},
    {"four.blend", "BLENDER-v400REND", "is a Blender file of version 4.0, which"},
    {"five.blend", "BLENDER17-01v0502REND", "is a Blender file of version 5.2, which"},
    {"old.blend", "BLENDER-v279REND", "cannot be read: "},
    {"README", "facet solid outer\n", "is not a model in a format that can be read"},
    {"box.mdl", "UMDL\1", "is a model of Urho3D, which"},
    {"bird.m3d", "3DMO", "is Model 3D (M3D), which"},
    {"bird", "3dmodel 1\n", "is Model 3D (M3D), which"},
    {"mesh.vtp", "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">", "is VTK, which"},
    {"mesh", "# vtk DataFile Version 3.0\n", "is VTK, which"},
    {"a.mesh", "MeshVersionFormatted 1\nDimension 3\n", "is a mesh of Medit, which"},
    {"a.mesh", "RSCC\x02", "is a resource of Godot, which"},
    {"a.mesh", "RSRC\x01", "is a resource of Godot, which"},
    {"a.msh", "anything", "is a mesh of Gmsh, which"},
    {"a.obj", "$MeshFormat\n4.1 0 8\n", "is a mesh of Gmsh, which"},
    {"a.pts", "[Expe/PointSet/Binary/0.1]\nproperty position 12\n", "is a point set of Expe, which"},
    {"a.amf", "PK\3\4", "is an AMF in a ZIP archive, which is not supported"},
    {"a.assbin", "anything", "is a binary dump of assimp, which is not supported"},
    {"a.x", "ASSIMP.binary-dump.Fri Nov 27", "is a binary dump of assimp, which is not supported"},
    {"a.bim", "{\"schema_version\": \"1.0.0\"}", "is dotbim, which"},
    {"a.glb", "b3dm\x01", "is 3D Tiles, which"},
    {"a.glb", "i3dm\x01", "is 3D Tiles, which"},
    {"a.glb", "pnts\x01", "is 3D Tiles, which"},
    {"a.glb", "cmpt\x01", "is 3D Tiles, which"},
    {"a.b3dm", "anything", "is 3D Tiles, which"},
    {"a.i3dm", "anything", "is 3D Tiles, which"},
    {"a.pnts", "anything", "is 3D Tiles, which"},
    {"a.cmpt", "anything", "is 3D Tiles, which"},
    {"cloud.pcd", "VERSION .7\n", "is PCD (point cloud), which"},
    {"scan.txt", "LASF", "is LAS (point cloud), which"},
    {"pointer.glb", LFS, "is a Git LFS pointer, not the file (git lfs pull)"},
    {"pointer.stl", LFS, "is a Git LFS pointer"},
    {"pointer.usdz", LFS, "is a Git LFS pointer"},
    {"pointer", LFS, "is a Git LFS pointer"},
    {"annex.fbx", "/annex/objects/SHA256E-s1--00.fbx\n",
     "is a git-annex pointer, not the file (git annex get)"},
};

static void test_bad_files(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof bad_files / sizeof bad_files[0]; i++) {
        write_text(bad_files[i].name, bad_files[i].text);
        expect_refused(bad_files[i].name, bad_files[i].cause);
    }
}

// A Blender file of version 2.93, compressed by gzip.
static void test_compressed_blender(void **state)
{
    (void)state;
    static const unsigned char head[] = {0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00,
                                         0x00, 0x03, 0x01, 0x11, 0x00, 0xee, 0xff},
                               tail[] = {0xd6, 0x68, 0xe5, 0x84, 0x11, 0x00, 0x00, 0x00};
    static const char text[] = "BLENDER_v293RENDH";
    unsigned char bytes[64];
    const size_t length = strlen(text);
    memcpy(bytes, head, sizeof head);
    memcpy(bytes + sizeof head, text, length);
    memcpy(bytes + sizeof head + length, tail, sizeof tail);
    write_bytes("gzip.blend", bytes, sizeof head + length + sizeof tail);
    expect_refused("gzip.blend", "is a Blender file of version 2.93, which is not supported");
}

// What stands in the place of a texture, a library or a buffer.
static void test_pointers(void **state)
{
    (void)state;
    write_text("pointer.png", LFS);
    write_text("pointer.mtl", LFS);
    write_text("map.mtl", "newmtl m\nmap_Kd pointer.png\n");
    struct scene_model *model =
        load_text("lfs.obj", "mtllib map.mtl\nmtllib pointer.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\n"
                             "v 0 1 0\nf 1 2 3\n");
    assert_true(
        has_warning(model, "texture \"pointer.png\": is a Git LFS pointer, not the file (git lfs pull)"));
    assert_true(has_warning(model, "material library \"pointer.mtl\": is a Git LFS pointer"));
    scene_model_free(model);
    write_text("pointer.bin", LFS);
    write_text("lfs.gltf",
               "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{"
               "\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":"
               "5126,\"type\":\"VEC3\",\"count\":1}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":12}],"
               "\"buffers\":[{\"byteLength\":12,\"uri\":\"pointer.bin\"}]}");
    expect_refused("lfs.gltf", "buffers[0]: \"pointer.bin\": is a Git LFS pointer");
}

// A node with two parents, and one that stands twice among the children of its parent, are drawn once.
static void test_two_parents(void **state)
{
    (void)state;
    struct scene_model *model = load_text(
        "parents.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"children\":[2,3,3,3,3,3,3,3,3]},{\"children\":["
        "2],\"translation\":[5,0,0]},{\"mesh\":0},{\"mesh\":0}],\"meshes\":[{\"primitives\":[{"
        "\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{\"componentType\":5126,\"type\":\"VEC3\","
        "\"count\":3}]}");
    assert_int_equal(model->instance_count, 2);
    assert_true(model->instances[0].world[12] == 0);
    assert_true(has_warning(
        model, "nodes[2] has two parents, nodes[0] and nodes[1]: drawn once, as a child of the first"));
    assert_true(has_warning(model, "nodes[3] has two parents, nodes[0] and nodes[0]"));
    scene_model_free(model);
}

// Writes a GLB whose JSON has no multiple of four bytes; the next chunk follows at once or behind padding.
static void write_unaligned(bool is_padded)
{
    static const char json[] =
        "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{"
        "\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,"
        "\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}],\"bufferViews\":[{\"buffer\":0,"
        "\"byteLength\":36}],\"buffers\":[{\"byteLength\":36}]}";
    const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    unsigned char bytes[1024] = "glTF\2";
    const uint32_t length = (uint32_t)strlen(json) + (strlen(json) % 4 == 0), size = 36;
    const size_t next = 20 + (is_padded ? (length + 3) / 4 * 4 : length);
    const uint32_t whole = (uint32_t)next + 8 + size;
    memset(bytes + 20, ' ', 900);
    memcpy(bytes + 20, json, strlen(json));
    memcpy(bytes + 8, &whole, 4);
    memcpy(bytes + 12, &length, 4);
    memcpy(bytes + 16, "JSON", 4);
    memcpy(bytes + next, &size, 4);
    memcpy(bytes + next + 4, "BIN", 4);
    memcpy(bytes + next + 8, corners, sizeof corners);
    write_bytes("unaligned.glb", bytes, whole);
}

static void test_unaligned_chunk(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        write_unaligned(i == 1);
        struct scene_model *model = load("unaligned.glb");
        assert_int_equal(model->triangles_drawn, 1);
        assert_true(has_warning(model, "the JSON chunk of the GLB has "));
        assert_true(has_warning(model, " bytes, which is no multiple of 4"));
        scene_model_free(model);
    }
}

static void test_index_zero(void **state)
{
    (void)state;
    struct scene_model *model = load_text(
        "zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1 2 3\nf 0 1 2\nl 1 0\np 0\nf 3//1 2 0/1\n");
    assert_int_equal(model->instance_count, 1);
    assert_int_equal(model->triangles_drawn, 1);
    assert_true(has_warning(model, "faces, lines and points with an index of 0 are left out, 4 of them"));
    scene_model_free(model);
    model = load_text("other.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/0 2/1 3/1\n");
    assert_int_equal(model->triangles_drawn, 1);
    assert_null(model->meshes[0].uvs[0]);
    assert_true(has_warning(model, "texture coordinates and normals with an index of 0 are left out"));
    scene_model_free(model);
}

static void test_no_files(void **state)
{
    (void)state;
    expect_refused("does not exist.gltf", "No such file");
    expect_refused("", "is a folder");
    assert_int_equal(mkfifo(path_of("pipe.obj"), 0600), 0);
    expect_refused("pipe.obj", "is not a regular file");
}

// A texture or a material library that is a pipe or a device must not be waited for, and is told as what it is.
static void test_pipe_as_texture(void **state)
{
    (void)state;
    assert_int_equal(mkfifo(path_of("pipe.png"), 0600), 0);
    write_text("pipe.mtl", "newmtl m\nmap_Kd pipe.png\n");
    struct scene_model *model =
        load_text("piped.obj", "mtllib pipe.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    assert_true(has_warning(model, "texture \"pipe.png\": is not a regular file; drawn in magenta"));
    assert_true(model->images[0].missing);
    // Its stand-in has hard edges.
    const struct scene_texture_slot *const slot = &model->materials[0].slots[SCENE_SLOT_BASE_COLOR];
    assert_true(slot->min_filter == RHW_FILTER_NEAREST && slot->mag_filter == RHW_FILTER_NEAREST);
    scene_model_free(model);
    assert_int_equal(mkfifo(path_of("library.mtl"), 0600), 0);
    model = load_text("library.obj", "mtllib library.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    assert_true(has_warning(model, "material library \"library.mtl\": is not a regular file"));
    scene_model_free(model);
    assert_int_equal(mkdir(path_of("maps"), 0700) | mkfifo(path_of("maps/Moved.png"), 0600), 0);
    write_text("moved.mtl", "newmtl m\nmap_Kd moved.png\n");
    model = load_text("moved.obj", "mtllib moved.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    assert_true(has_warning(model, "texture \"moved.png\": is not a regular file; drawn in magenta"));
    scene_model_free(model);
    remove_folder("maps");
    write_text("zero.mtl", "newmtl m\nmap_Kd /dev/zero\n");
    model = load_text("zero.obj", "mtllib zero.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    assert_true(has_warning(model, "texture \"/dev/zero\": is not a regular file; drawn in magenta"));
    scene_model_free(model);
}

static void test_not_finite(void **state)
{
    (void)state;
    struct scene_model *model = load_text(
        "nan.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nv 1e999 0 0\nf 1 2 3\nf 1 2 4\nf 1 5 3\n");
    assert_int_equal(model->triangles_drawn, 1);
    assert_true(has_warning(model, "primitives with positions that are not finite are left out, 2 of them"));
    scene_model_free(model);
    // Points that no face uses may be anything; a matrix that leaves the range of floats drops its node.
    model = load_text("far.gltf", "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0},{\"mesh\":0,"
                                  "\"translation\":[1,1,1],\"scale\":[3e38,3e38,3e38]},"
                                  "{\"mesh\":0,\"matrix\":[1e39,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}],"
                                  "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
                                  "\"accessors\":[{\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}]}");
    assert_int_equal(model->instance_count, 2);
    assert_true(has_warning(model, "not finite"));
    scene_model_free(model);
}

static void test_nothing_to_draw(void **state)
{
    (void)state;
    struct scene_model *model = load_text("bare.gltf", "{\"asset\":{\"version\":\"2.0\"}}");
    assert_int_equal(model->instance_count, 0);
    assert_true(model->bounds_min[0] > model->bounds_max[0]);
    scene_model_free(model);
}

// 20,000 nodes, each the child of the one before: deep, but no cycle.
static void test_deep_tree(void **state)
{
    (void)state;
    FILE *file = fopen(path_of("deep.gltf"), "w");
    assert_non_null(file);
    fputs("{\"asset\":{\"version\":\"2.0\"},\"nodes\":[", file);
    for (int i = 1; i < 20000; i++) {
        fprintf(file, "{\"children\":[%d]},", i);
    }
    fputs("{}]}", file);
    assert_int_equal(fclose(file), 0);
    scene_model_free(load("deep.gltf"));
}

// Little text that asks for much work: a thousand primitives that each use one of 16 million points.
static void write_slow_file(void)
{
    FILE *file = fopen(path_of("slow.gltf"), "w");
    assert_non_null(file);
    fputs("{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"accessors\":[{\"componentType\":5126,"
          "\"type\":\"VEC3\","
          "\"count\":16777216},{\"componentType\":5125,\"type\":\"SCALAR\",\"count\":1}],\"meshes\":[{"
          "\"primitives\":[",
          file);
    for (int i = 0; i < 1000; i++) {
        fprintf(file, "%s{\"mode\":0,\"attributes\":{\"POSITION\":0},\"indices\":1}", i > 0 ? "," : "");
    }
    fputs("]}]}", file);
    assert_int_equal(fclose(file), 0);
}

static void test_limits(void **state)
{
    (void)state;
    char error[512] = "";
    write_slow_file();
    const struct scene_model_options time_limit = {.seconds = 1};
    struct timespec start, end;
    clock_gettime(CLOCK_MONOTONIC, &start);
    assert_null(scene_model_load(path_of("slow.gltf"), &time_limit, error, sizeof error));
    clock_gettime(CLOCK_MONOTONIC, &end);
    assert_true(end.tv_sec - start.tv_sec < 30);
    assert_non_null(
        strstr(error, "import took more than ")); // of processor time; on a busy machine of wall time
}

// Under a sanitizer the limit is off: its shadow memory would exceed any.
static void test_memory_limit(void **state)
{
    (void)state;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    skip();
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
    skip();
#endif
#endif
    char error[512] = "";
    write_slow_file();
    const struct scene_model_options memory_limit = {.memory = (size_t)128 << 20};
    assert_null(scene_model_load(path_of("slow.gltf"), &memory_limit, error, sizeof error));
    assert_non_null(strstr(error, "needs more memory"));
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_compressed_blender), cmocka_unit_test(test_pointers),
    cmocka_unit_test(test_two_parents),        cmocka_unit_test(test_unaligned_chunk),
    cmocka_unit_test(test_index_zero),         cmocka_unit_test(test_bad_files),
    cmocka_unit_test(test_no_files),           cmocka_unit_test(test_pipe_as_texture),
    cmocka_unit_test(test_not_finite),         cmocka_unit_test(test_nothing_to_draw),
    cmocka_unit_test(test_deep_tree),          cmocka_unit_test(test_limits),
    cmocka_unit_test(test_memory_limit),
};

const struct unit_tests test_import_bad = UNIT_TESTS(tests, make_directory, remove_directory);
