// SPDX-License-Identifier: MIT
// Which reader a file is for. Where formats have a mark, what the file begins with decides. Elsewhere the ending of its
// name decides, and where it has none, as on standard input, what the file looks like decides.
#include "kind.h"

#include <errno.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "file.h"
#include "import/builder/readers.h"
#include "import/builder/text_lines.h"

enum { LOOKED_AT = 16384 }; // enough for the header of a STEP file

struct beginning {
    unsigned char bytes[LOOKED_AT + 1]; // the bytes and a 0 behind them
    size_t count;
    uint64_t file_size;
};

// Formats that nothing here reads. Without this table a guess of assimp's would refuse them.
static const struct {
    const char *ending, *name;
} unread[] = {
    {"usd", "USD"},
    {"usda", "USD (text)"},
    {"usdc", "USD (binary)"},
    {"usdz", "USD (package)"},
    {"stp", "STEP (CAD)"},
    {"step", "STEP (CAD)"},
    {"stpz", "STEP (CAD)"},
    {"p21", "STEP (CAD)"},
    {"brep", "BREP (CAD)"},
    {"x_t", "Parasolid (CAD)"},
    {"x_b", "Parasolid (CAD)"},
    {"sat", "ACIS (CAD)"},
    {"jt", "JT (CAD)"},
    {"dwg", "DWG (CAD)"},
    {"fcstd", "FreeCAD"},
    {"f3d", "Fusion 360"},
    {"ipt", "Inventor"},
    {"catpart", "CATIA"},
    {"scad", "OpenSCAD"},
    {"wrl", "VRML"},
    {"vrml", "VRML"},
    {"wrz", "VRML"},
    {"x3dv", "X3D (classic VRML)"},
    {"x3db", "X3D (binary)"},
    {"vtp", "VTK"},
    {"vtk", "VTK"},
    {"vtu", "VTK"},
    {"pcd", "PCD (point cloud)"},
    {"las", "LAS (point cloud)"},
    {"laz", "LAZ (point cloud)"},
    {"e57", "E57 (point cloud)"},
    {"ptx", "PTX (point cloud)"},
    {"abc", "Alembic"},
    {"vdb", "OpenVDB"},
    {"vox", "MagicaVoxel"},
    {"m3d", "Model 3D (M3D)"},
    {"3dm", "Rhino 3DM"},
    {"skp", "SketchUp"},
    {"max", "3ds Max"},
    {"ma", "Maya (text)"},
    {"mb", "Maya (binary)"},
    {"c4d", "Cinema 4D"},
    {"bim", "dotbim"},
    {"b3dm", "3D Tiles"},
    {"i3dm", "3D Tiles"},
    {"pnts", "3D Tiles"},
    {"cmpt", "3D Tiles"},
    {"msh", "a mesh of Gmsh"},
    {"igs", "IGES"},
    {"iges", "IGES"},
    {"sldprt", "SolidWorks"},
    {"splat", "Gaussian splats"},
    {"spz", "Gaussian splats (SPZ)"},
    {"assbin", "a binary dump of assimp"}, // assimp trusts the lengths in it
};

// How files of formats that nothing here reads begin, whatever their names say.
static const struct {
    const char *mark, *name;
} unread_marks[] = {
    {"#usda", "USD (text)"},
    {"PXR-USDC", "USD (binary)"},
    {"#VRML V1", "VRML 1.0"},
    {"#VRML V2", "VRML"},
    {"#X3D V", "X3D (classic VRML)"},
    {"# vtk DataFile", "VTK"},
    {"<VTKFile", "VTK"},
    {"# .PCD", "PCD (point cloud)"},
    {"LASF", "LAS (point cloud)"},
    {"ASTM-E57", "E57 (point cloud)"},
    {"AC10", "DWG (CAD)"},
    {"VOX ", "MagicaVoxel"},
    {"3DMO", "Model 3D (M3D)"},
    {"UMDL", "a model of Urho3D"},
    {"UMD2", "a model of Urho3D"},
    {"3dmodel ", "Model 3D (M3D)"},
    {"MeshVersionFormatted", "a mesh of Medit"},
    {"$MeshFormat", "a mesh of Gmsh"},
    {"[Expe/PointSet", "a point set of Expe"},
    {"RSRC", "a resource of Godot"},
    {"RSCC", "a resource of Godot"},
    {"b3dm", "3D Tiles"},
    {"i3dm", "3D Tiles"},
    {"pnts", "3D Tiles"},
    {"cmpt", "3D Tiles"},
    {"ASSIMP.binary-dump", "a binary dump of assimp"},
};

// How archives and compressed files begin, each with the one format of models that it may be, or for ZIP, which many
// are, with the ending that says no more.
static const struct {
    const char *mark, *name, *but, *only;
} archives[] = {
    {"\x1f\x8b", "compressed by gzip", "blend", NULL},
    {"BZh", "compressed by bzip2", NULL, NULL},
    {"\xfd"
     "7zXZ",
     "compressed by xz", NULL, NULL},
    {"7z\xbc\xaf\x27\x1c", "a 7-Zip archive", NULL, NULL},
    {"Rar!\x1a", "a RAR archive", NULL, NULL},
    {"PK\3\4", "a ZIP archive", NULL, "zip"},
};

// Files that are no model, whatever their names say. A reader would complain of details.
static const struct {
    const char *mark, *name;
} others[] = {
    {"\x89PNG\r\n", "a PNG picture"}, {"\xff\xd8\xff", "a JPEG picture"}, {"GIF8", "a GIF picture"},
    {"%PDF-", "a PDF document"},      {"\177ELF", "a program"},
};

const char *scene_model_unread_format(const char *name)
{
    const char *const dot = strrchr(name, '.');
    for (size_t i = 0; dot != NULL && i < sizeof unread / sizeof unread[0]; i++) {
        if (strcasecmp(dot + 1, unread[i].ending) == 0) {
            return unread[i].name;
        }
    }
    return NULL;
}

static struct beginning look(struct scene_import *import)
{
    struct beginning start = {.count = 0};
    struct stat status;
    const int descriptor = system_file_open_regular(import->model.path);
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "rb");
    if (file == NULL) {
        scene_import_fail(import, "cannot be opened: %s",
                          errno != 0 ? strerror(errno) : "not a regular file");
    }
    start.count = fread(start.bytes, 1, LOOKED_AT, file);
    start.file_size = fstat(fileno(file), &status) == 0 ? (uint64_t)status.st_size : 0;
    fclose(file);
    return start;
}

static bool begins_with(const struct beginning *start, const char *mark)
{
    return start->count >= strlen(mark) && memcmp(start->bytes, mark, strlen(mark)) == 0;
}

// Return the text of a file behind byte order marks and white space.
static const char *find_text(const struct beginning *start)
{
    const char *text = (const char *)start->bytes;
    text += scene_text_marks(text, start->count);
    return text + strspn(text, " \t\r\n");
}

// Return the ending of the file's name. Return "fbx" for an FBX whose name has none: of the formats that assimp reads,
// it alone has to be told from the others.
static const char *find_ending(const struct scene_import *import, const struct beginning *start)
{
    const char *slash = strrchr(import->name, '/'), *dot = strrchr(slash == NULL ? import->name : slash, '.');
    return dot != NULL ? dot + 1 : begins_with(start, "Kaydara FBX") ? "fbx" : "";
}

// Return true for HTML, in any case and behind a byte order mark and white space.
static bool looks_like_page(const struct beginning *start)
{
    const char *text = find_text(start);
    return strncasecmp(text, "<!doctype html", 14) == 0 || strncasecmp(text, "<html", 5) == 0;
}

static void refuse_others(struct scene_import *import, const struct beginning *start)
{
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        if (begins_with(start, others[i].mark)) {
            scene_import_fail(import, "is no model but %s", others[i].name);
        }
    }
    if (looks_like_page(start)) {
        scene_import_fail(import, "is no model but a web page");
    }
}

// Return true for an exchange file of STEP that has no schema of IFC. Files of IFC look alike and are read.
static bool is_step(const struct scene_import *import, const struct beginning *start)
{
    const char *text = find_text(start);
    if (strncmp(text, "ISO-10303-21", 12) != 0) {
        return false;
    }
    const char *schema = strstr(text, "FILE_SCHEMA"), *end = schema == NULL ? NULL : strchr(schema, ';');
    bool is_ifc = schema == NULL && strcasecmp(import->ending, "ifc") == 0;
    for (const char *c = schema; end != NULL && c < end && !is_ifc; c++) {
        is_ifc = strncasecmp(c, "IFC", 3) == 0;
    }
    return !is_ifc;
}

static bool is_exchange_file(const struct beginning *start)
{
    return strncmp(find_text(start), "ISO-10303-21", 12) == 0;
}

_Noreturn static void refuse_by_name(struct scene_import *import, const char *name)
{
    scene_import_fail(import, "is %s, which is not supported", name);
}

// Refuse a file for what it begins with.
static void refuse_marked(struct scene_import *import, const struct beginning *start)
{
    const char *pointer = scene_import_pointer_problem(start->bytes, start->count);
    if (pointer != NULL) {
        scene_import_fail(import, "%s", pointer);
    }
    if (is_step(import, start)) {
        refuse_by_name(import, "STEP (CAD)");
    }
    if (strcasecmp(import->ending, "asc") == 0 && strncasecmp(find_text(start), "ncols", 5) == 0) {
        refuse_by_name(import, "a grid of Esri (terrain)");
    }
    if (begins_with(start, "\x28\xb5\x2f\xfd")) {
        const bool is_blender = import->ending[0] == 0 || strncasecmp(import->ending, "blend", 5) == 0;
        refuse_by_name(import, is_blender ? "a Blender file of 3.0 or later (zstd)" : "compressed by zstd");
    }
    for (size_t i = 0; i < sizeof unread_marks / sizeof unread_marks[0]; i++) {
        if (strncmp(find_text(start), unread_marks[i].mark, strlen(unread_marks[i].mark)) == 0) {
            refuse_by_name(import, unread_marks[i].name);
        }
    }
}

static bool ends_in(const struct scene_import *import, const char *ending)
{
    return strcasecmp(import->ending, ending) == 0;
}

static void refuse_archive(struct scene_import *import, const struct beginning *start)
{
    for (size_t i = 0; i < sizeof archives / sizeof archives[0]; i++) {
        if (begins_with(start, archives[i].mark) &&
            (archives[i].but == NULL || !ends_in(import, archives[i].but)) &&
            (archives[i].only == NULL || ends_in(import, archives[i].only))) {
            scene_import_fail(import, "is %s, which is to be unpacked first", archives[i].name);
        }
    }
}

// Refuse a file for the ending of its name. An IFC may be called STEP.
static void refuse_unread(struct scene_import *import, const struct beginning *start)
{
    if (ends_in(import, "amf") && begins_with(start, "PK\3\4")) {
        refuse_by_name(import, "an AMF in a ZIP archive");
    }
    for (size_t i = 0; i < sizeof unread / sizeof unread[0] && !is_exchange_file(start); i++) {
        if (strcasecmp(import->ending, unread[i].ending) == 0) {
            refuse_by_name(import, unread[i].name);
        }
    }
    refuse_archive(import, start);
}

// Return true for a text whose first word outside of comments is one of OBJ's.
static bool looks_like_obj(const struct beginning *start)
{
    static const char *const words[] = {"v ", "vn ", "vt ", "o ", "g ", "mtllib ", "usemtl ", "s "};
    const char *line = find_text(start);
    while (*line == '#' || *line == '\n' || *line == '\r') {
        const size_t length = strcspn(line, "\r\n");
        line += length + strspn(line + length, "\r\n");
    }
    bool found = false;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        found = found || strncmp(line, words[i], strlen(words[i])) == 0;
    }
    return found;
}

static bool looks_like_json(const struct beginning *start)
{
    return *find_text(start) == '{';
}

static bool looks_like_stl(const struct beginning *start)
{
    const unsigned char *b = start->bytes;
    const uint64_t facets = b[80] | (uint64_t)b[81] << 8 | (uint64_t)b[82] << 16 | (uint64_t)b[83] << 24;
    return strncmp(find_text(start), "solid ", 6) == 0 ||
           (start->count > 84 && start->file_size == 84 + 50 * facets);
}

void scene_import_read(struct scene_import *import)
{
    const struct beginning start = look(import);
    import->ending = find_ending(import, &start);
    const bool nameless = import->ending[0] == 0;
    refuse_others(import, &start);
    refuse_marked(import, &start);
    if (scene_import_is_gltf(import->name, start.bytes, start.count) ||
        (nameless && looks_like_json(&start))) {
        scene_import_gltf(import);
    } else if (scene_import_is_ply(import->name, start.bytes, start.count)) {
        scene_import_ply(import);
    } else if (ends_in(import, "obj") || (nameless && looks_like_obj(&start))) {
        scene_import_obj(import);
    } else if (ends_in(import, "3mf") || (nameless && begins_with(&start, "PK\3\4"))) {
        scene_import_3mf(import);
    } else if (ends_in(import, "stl") || (nameless && looks_like_stl(&start))) {
        scene_import_stl(import);
    } else if (ends_in(import, "xyz") || ends_in(import, "pts") || ends_in(import, "asc")) {
        scene_import_xyz(import);
    } else if (ends_in(import, "off") || scene_import_is_off(start.bytes, start.count)) {
        scene_import_off(import);
    } else {
        refuse_unread(import, &start);
        if (ends_in(import, "fbx")) {
            scene_import_check_fbx(import);
        }
        scene_import_assimp(import);
    }
}
