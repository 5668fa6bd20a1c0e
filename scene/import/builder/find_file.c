// SPDX-License-Identifier: MIT
// The file that a model means by a name, either as it is written or as people move files about, and whether it may be
// read. The places are gone through for each form of the name (name_forms.h).
#include "find_file.h"

#include <stdlib.h>
#include <string.h>

#include "archive.h"
#include "confine.h"
#include "data_uri.h"
#include "folder.h"
#include "name_forms.h"

enum {
    LONGEST = 4096,      // bytes of a name, as long as Linux lets a path be
    MOST_COMPONENTS = 64 // components at the end of a path that are looked for beside the model
};

struct search {
    struct scene_import *import;
    // Folders with slashes at their ends: the folder of the file that has the name, and the model's.
    const char *folders[2];
    int folder_count;
    char stem[256]; // name of the model without its ending
    char *path;     // path under trial
    size_t room;
};

// Return true if there is a file in a folder, below `inside`, in any case or, if it may, with any ending.
static bool try_folder(const struct search *search, const char *folder, const char *inside, const char *name,
                       bool any_ending)
{
    snprintf(search->path, search->room, "%s%s%s", folder, inside, name);
    return scene_folder_find(search->import, search->path, strlen(folder), any_ending);
}

static bool find_as_named(const struct search *search, const char *name)
{
    for (int i = 0; i < search->folder_count; i++) {
        snprintf(search->path, search->room, "%s%s", name[0] == '/' ? "" : search->folders[i], name);
        if (scene_import_is_file(search->import, search->path)) {
            return true;
        }
    }
    return false;
}

// Return the part of a path that has at most MOST_COMPONENTS components.
static const char *end_of_path(const char *name)
{
    const char *end = name + strlen(name);
    for (int slashes = 0; end > name; end--) {
        slashes += end[-1] == '/';
        if (slashes > MOST_COMPONENTS) {
            break;
        }
    }
    return end;
}

// Find the file that a path of another machine means, on which the model was made. As much of the path's end as stands
// in the folder is meant.
static bool find_end_of_path(const struct search *search, const char *name, bool any_ending)
{
    for (const char *end = end_of_path(name); end != NULL; end = strchr(end, '/')) {
        end += *end == '/';
        for (int i = 0; i < search->folder_count; i++) {
            if (try_folder(search, search->folders[i], "", end, any_ending)) {
                return true;
            }
        }
    }
    return false;
}

// Find a file in one of the folders that archives of models have. Gazebo and ROS keep meshes/ or meshes/visual/ beside
// materials/textures/, and the libraries of FBX unpack images into MODEL.fbm/.
static bool find_in_usual_folder(const struct search *search, const char *name, bool any_ending)
{
    static const char *const folders[] = {
        "textures/",
        "texture/",
        "tex/",
        "maps/",
        "images/",
        "../textures/",
        "../texture/",
        "../images/",
        "../tex/",
        "../maps/",
        "materials/",
        "materials/textures/",
        "../materials/",
        "../materials/textures/",
        "../../materials/textures/",
        "../../textures/",
    };
    static const char *const own[] = {".fbm/", "/"};
    const char *const slash = strrchr(name, '/'), *const file = slash == NULL ? name : slash + 1;
    char inside[sizeof search->stem + 8];
    for (int i = 0; i < search->folder_count; i++) {
        for (size_t k = 0; k < sizeof folders / sizeof folders[0]; k++) {
            if (try_folder(search, search->folders[i], folders[k], file, any_ending)) {
                return true;
            }
        }
        for (size_t k = 0; k < sizeof own / sizeof own[0] && search->stem[0] != 0; k++) {
            snprintf(inside, sizeof inside, "%s%s", search->stem, own[k]);
            if (try_folder(search, search->folders[i], inside, file, any_ending)) {
                return true;
            }
        }
    }
    return false;
}

// Find a file in a folder beside one of those that the model is in. Gazebo (model://suv/meshes/a.png) and ROS
// (package://) name a package first, whose folder is the model's own or a neighbour of it.
static bool find_in_package(const struct search *search, const char *name)
{
    enum { HIGHEST = 8 };
    char above[3 * HIGHEST + 1] = "";
    for (int up = 0; up < HIGHEST; up++) {
        strcat(above, "../");
        for (int i = 0; i < search->folder_count; i++) {
            if (try_folder(search, search->folders[i], above, name, false)) {
                return true;
            }
        }
    }
    return false;
}

static bool find_moved(const struct search *search, const char *name, bool any_ending)
{
    return find_end_of_path(search, name, any_ending) || find_in_usual_folder(search, name, any_ending);
}

// Find a file by the forms from `first` on.
static bool find_forms(const struct search *search, const struct scene_name_forms *forms, size_t first)
{
    for (size_t i = first; i < forms->count; i++) {
        if (find_as_named(search, forms->names[i])) {
            return true;
        }
    }
    for (size_t i = first; i < forms->count; i++) {
        if (find_moved(search, forms->names[i], false)) {
            return true;
        }
    }
    return false;
}

static bool is_ascii(const char *name)
{
    while (*name != 0 && (unsigned char)*name < 0x80) {
        name++;
    }
    return *name == 0;
}

static bool find_anywhere(const struct search *search, const char *name, bool is_image)
{
    struct scene_name_forms forms = {0};
    if (strncmp(name, "file://", 7) == 0) {
        name += 7;
    }
    // Blender begins paths relative to the model like this.
    if (strncmp(name, "//", 2) == 0) {
        name += 2;
    }
    const bool has_package = strncmp(name, "model://", 8) == 0 || strncmp(name, "package://", 10) == 0;
    if (has_package) {
        name = strchr(name, ':') + 3;
    }
    scene_name_forms_add(search->import, &forms, name);
    bool found = false;
    for (size_t i = 0; i < forms.count && !found && has_package; i++) {
        found = find_in_package(search, forms.names[i]);
    }
    found = found || find_forms(search, &forms, 0);
    // A URI may have its accents encoded: all forms so far are looked at.
    const size_t spelled = forms.count;
    for (size_t i = 0; i < spelled && !found; i++) {
        if (!is_ascii(forms.names[i])) {
            scene_name_forms_add_accents(search->import, &forms, forms.names[i]);
        }
    }
    found = found || find_forms(search, &forms, spelled);
    if (!found && !is_ascii(name)) {
        const size_t first = forms.count;
        scene_name_forms_add_code_pages(search->import, &forms, name);
        found = find_forms(search, &forms, first);
    }
    for (size_t i = 0; i < forms.count && !found && is_image; i++) {
        found = find_moved(search, forms.names[i], true);
    }
    scene_name_forms_free(&forms);
    return found;
}

// Set the name of the model without its folder and its ending. It stays empty if there is none.
static void set_stem(struct search *search)
{
    const char *const name = search->import->name, *const slash = strrchr(name, '/'),
                      *const file = slash == NULL ? name : slash + 1, *const dot = strrchr(file, '.');
    const size_t length = dot == NULL ? 0 : (size_t)(dot - file);
    if (length < sizeof search->stem) {
        memcpy(search->stem, file, length);
    }
}

static const char *find(struct scene_import *import, const char *folder, const char *name, bool is_image)
{
    const char *const own = import->directory[0] != 0 ? import->directory : "./";
    struct search search = {.import = import, .folders = {own, own}, .folder_count = 1};
    if (folder != NULL && folder[0] != 0 && strcmp(folder, own) != 0) {
        search.folders[0] = folder;
        search.folder_count = 2;
    }
    if (strlen(name) >= LONGEST) {
        import->missing = "the name is longer than that of a file can be";
        return NULL;
    }
    enum { LONGER = 16 }; // a byte of the name is up to four bytes in another code page, and these again
    search.room = strlen(search.folders[0]) + strlen(own) + sizeof search.stem + 64 + LONGER * strlen(name);
    search.path = scene_import_allocate(import, search.room, 1);
    set_stem(&search);
    import->missing = import->confine != NULL ? "is not a file of the folder that may be read (--confine)"
                                              : "No such file or directory";
    const char *path = NULL;
    if (find_anywhere(&search, name, is_image)) {
        path = strcpy(scene_import_allocate(import, strlen(search.path) + 1, 1), search.path);
    }
    free(search.path);
    return path;
}

const char *scene_import_find_file(struct scene_import *import, const char *name)
{
    return find(import, NULL, name, false);
}

void scene_import_find_image(struct scene_import *import, const char *folder, const char *name,
                             struct scene_import_source *source)
{
    if (scene_data_uri_is(name)) {
        source->bytes = scene_data_uri_decode(import, name, &source->size);
        source->problem = "its data URI is not valid base64";
        return;
    }
    source->bytes = scene_import_find_entry(import, name, &source->size);
    if (source->bytes != NULL) {
        return;
    }
    source->file = find(import, folder, name, true);
    source->problem = import->missing;
}
