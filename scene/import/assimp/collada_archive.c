// SPDX-License-Identifier: MIT
// Collada in a ZIP archive (.zae), with its images. assimp 5.2.5 finds no image there that is in a folder, and its text
// could not be changed before assimp reads it. The document is therefore taken out here.
#include "assimp.h"
#include "collada_markup.h"
#include "import/builder/archive.h"
#include "import/builder/name_forms.h"

#include <string.h>
#include <strings.h>

// Return the text of an element of a manifest, without the blanks about it. Return NULL if there is none.
static const char *find_root(struct scene_import *import, char *manifest, size_t size)
{
    for (char *c = strchr(manifest, '<'); c != NULL; c = strchr(c, '<')) {
        char *const close = scene_collada_markup_end(c, manifest + size);
        if (close == NULL) {
            return NULL;
        }
        if (scene_collada_is_tag(c, "dae_root") && close[-1] != '/') {
            const char *text = close + 1 + strspn(close + 1, " \t\r\n");
            size_t length = strcspn(text, "<");
            while (length > 0 && scene_collada_is_blank(text[length - 1])) {
                length--;
            }
            return scene_import_string(import, text, length);
        }
        c = close;
    }
    return NULL;
}

// Return the document that the manifest names. Return NULL if there is no manifest, or nothing that it names.
static char *read_named(struct scene_import *import, struct scene_zip *zip, size_t *size)
{
    size_t manifest_size;
    char *const manifest = scene_zip_read_all(zip, "manifest.xml", &manifest_size);
    const char *const root = manifest == NULL ? NULL : find_root(import, manifest, manifest_size);
    struct scene_name_forms forms = {0};
    char *text = NULL;
    if (root != NULL) {
        scene_name_forms_add(import, &forms, root);
    }
    for (size_t i = 0; i < forms.count && text == NULL; i++) {
        const char *name = forms.names[i];
        name += strncmp(name, "./", 2) == 0 ? 2 : name[0] == '/';
        text = scene_zip_read_all(zip, name, size);
        if (text != NULL) {
            scene_import_enter_archive(import, zip, name);
        }
    }
    scene_name_forms_free(&forms);
    return text;
}

char *scene_assimp_read_zae(struct scene_import *import, size_t *size)
{
    struct scene_zip *const zip = import->archive != NULL ? import->archive->zip : scene_zip_open(import);
    char *text = read_named(import, zip, size);
    if (text == NULL) {
        const char *const name = scene_zip_find_ending(zip, ".dae");
        if (name == NULL) {
            scene_import_fail(import, "is an archive without a document of Collada (.dae)");
        }
        text = scene_zip_read_all(zip, name, size);
        scene_import_enter_archive(import, zip, name);
    }
    return text;
}
