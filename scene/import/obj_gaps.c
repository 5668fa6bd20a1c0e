// SPDX-License-Identifier: MIT
// Statements of OBJ that are not drawn. What belongs to free-form curves and surfaces is told with these.
#include "obj.h"

// Tell of a statement that would draw something. Return false if the key names none.
static bool tell_of_drawing(struct obj *obj, struct scene_word key)
{
    static const char free_form[] = "free-form curves and surfaces";
    static const struct {
        const char *key, *what;
    } statements[] = {
        {"curv", free_form},
        {"curv2", free_form},
        {"surf", free_form},
        {"cstype", free_form},
        {"bsp", free_form},
        {"bzp", free_form},
        {"cdc", free_form},
        {"cdp", free_form},
        {"call", "other files, which call names"},
        {"csh", "commands (csh)"},
        {"usemap", "texture maps (usemap)"},
        {"shadow_obj", "other objects for shadows (shadow_obj)"},
        {"trace_obj", "other objects for reflections (trace_obj)"},
    };
    for (size_t i = 0; i < sizeof statements / sizeof statements[0]; i++) {
        if (scene_word_is(key, statements[i].key)) {
            scene_import_unsupported(obj->import, "%s: not drawn", statements[i].what);
            return true;
        }
    }
    return false;
}

// Tell of a switch that is on and is not drawn. Return false if the key names none.
static bool tell_of_switch(struct obj *obj, struct scene_word key, struct scene_line line)
{
    static const char *const switches[] = {"bevel", "c_interp", "d_interp", "lod"};
    struct scene_word setting;
    for (size_t i = 0; i < sizeof switches / sizeof switches[0]; i++) {
        if (scene_word_is(key, switches[i])) {
            const bool is_on = scene_text_word(&line, &setting) && !scene_word_is(setting, "off") &&
                               !scene_word_is(setting, "0");
            if (is_on) {
                scene_import_unsupported(obj->import, "%s (OBJ): not used", switches[i]);
            }
            return true;
        }
    }
    return false;
}

void scene_obj_tell_of_statement(struct obj *obj, struct scene_word key, struct scene_line line)
{
    static const char *const parts[] = {"vp", "deg", "bmat", "step", "parm",  "trim",  "hole", "scrv",
                                        "sp", "end", "con",  "mg",   "ctech", "stech", "res",  "maplib"};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        if (scene_word_is(key, parts[i])) {
            return;
        }
    }
    if (!tell_of_drawing(obj, key) && !tell_of_switch(obj, key, line)) {
        scene_unknown_words_tell(obj->import, &obj->unknown, key);
    }
}
