// SPDX-License-Identifier: MIT
// See stage_explain.h. Names and numbers stand in one order, vertex by vertex.
#include "stage_explain.h"

#include "stage.h"
#include "stage_shaders.h"

#include <math.h>

const char *stage_number_names(void)
{
    return "triangle,clipped,snapped,smooth,"
           "X_0,Y_0,Z_0,W_0,X_1,Y_1,Z_1,W_1,X_2,Y_2,Z_2,W_2,"
           "x_0,y_0,x_1,y_1,x_2,y_2,"
           "x_P,y_P,e_0,e_1,e_2,r,s,t,inverse_w,a,b,c,depth,"
           "u_0,v_0,red_0,green_0,blue_0,u_1,v_1,red_1,green_1,blue_1,u_2,v_2,red_2,green_2,blue_2,"
           "u,v,red,green,blue,output_red,output_green,output_blue,"
           "method,world_x,world_y,world_z,world_a,world_b,world_c,world_u,world_v,world_green";
}

enum { WORLD_NUMBERS = 9 }; // the last names

struct list {
    double *numbers;
    int count;
};

static void add(struct list *list, double number)
{
    list->numbers[list->count++] = number;
}

static void add_floats(struct list *list, const float *values, int count)
{
    for (int i = 0; i < count; i++) {
        add(list, (double)values[i]);
    }
}

// Where vertices were snapped to, the sample, and the edge functions there.
static void add_raster(struct list *list, const struct rhw_explained_fragment *f)
{
    for (int i = 0; i < 3; i++) {
        add(list, f->is_snapped ? f->x[i] : (double)NAN);
        add(list, f->is_snapped ? f->y[i] : (double)NAN);
    }
    add(list, f->sample_x);
    add(list, f->sample_y);
    for (int i = 0; i < 3; i++) {
        add(list, f->is_clipped || !f->is_snapped ? (double)NAN : (double)f->edge[i]);
    }
}

int stage_explain_numbers(const struct rhw_explained_fragment *f, int method,
                          double numbers[STAGE_MAX_NUMBERS])
{
    struct list list = {.numbers = numbers};
    add(&list, f->draw);
    add(&list, f->is_clipped);
    add(&list, f->is_snapped);
    add(&list, f->qualifiers[STAGE_U] == RHW_SMOOTH);
    for (int i = 0; i < 3; i++) {
        add_floats(&list, f->position[i], 4);
    }
    add_raster(&list, f);
    for (int i = 0; i < 3; i++) {
        add(&list, f->screen[i]);
    }
    add(&list, f->inverse_w);
    add_floats(&list, f->weights, 3);
    add(&list, (double)f->depth);
    for (int i = 0; i < 3; i++) {
        add_floats(&list, f->vertex_varyings[i], STAGE_COMPONENTS);
    }
    add_floats(&list, f->varyings, STAGE_COMPONENTS);
    add_floats(&list, f->output[0], 3);
    add(&list, method);
    const int world = list.count;
    for (int i = 0; i < WORLD_NUMBERS; i++) {
        add(&list, (double)NAN);
    }
    return world;
}

void stage_explain_told(const struct rhw_explained_fragment *f, int told, double *world)
{
    struct list list = {.numbers = world, .count = 3 * (told - STAGE_TOLD_POINT)};
    add_floats(&list, f->output[0], 3);
}
