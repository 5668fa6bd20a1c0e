// SPDX-License-Identifier: MIT
// The mouse, and flying; see session.h.
#include "session.h"

#include "elementary.h"

#include <math.h>

enum { CLICK_PIXELS = 3, WHEEL_LINES = 3 };

static const double turn_of_height = 3.14159265358979323846; // radians, for a drag over the window's height
static const double zoom_of_notch = 0.85;
static const double nearest = 1e-4, farthest = 1e4; // that one can zoom to: times the model's extent
static const double speed = 0.6, fast = 4.0;        // of flying: times the model's extent in a second

static bool flies(void)
{
    const Uint8 *const keys = SDL_GetKeyboardState(NULL);
    return keys[SDL_SCANCODE_W] || keys[SDL_SCANCODE_A] || keys[SDL_SCANCODE_S] || keys[SDL_SCANCODE_D] ||
           keys[SDL_SCANCODE_Q] || keys[SDL_SCANCODE_E];
}

bool view_session_fly(struct view_session *s, double seconds)
{
    const Uint8 *const keys = SDL_GetKeyboardState(NULL);
    if (!s->model || !flies()) {
        return false;
    }
    const bool shift = (SDL_GetModState() & KMOD_SHIFT) != 0;
    const double step = s->extent * speed * (shift ? fast : 1.0) * (seconds < 0.1 ? seconds : 0.1);
    const double way[3] = {step * (keys[SDL_SCANCODE_D] - keys[SDL_SCANCODE_A]),
                           step * (keys[SDL_SCANCODE_E] - keys[SDL_SCANCODE_Q]),
                           step * (keys[SDL_SCANCODE_W] - keys[SDL_SCANCODE_S])};
    view_eye_fly(&s->eye, way);
    view_session_touch(s, true);
    return true;
}

// By parts of the window's height.
static void drag(struct view_session *s, double right, double down)
{
    const SDL_Keymod mod = SDL_GetModState();
    if (s->button == SDL_BUTTON_RIGHT || (mod & KMOD_SHIFT && !flies())) {
        view_eye_pan(&s->eye, right, -down);
    } else if (s->button == SDL_BUTTON_MIDDLE || mod & KMOD_CTRL || flies()) {
        view_eye_turn(&s->eye, s->vertical, 0.5 * right * turn_of_height, -0.5 * down * turn_of_height);
    } else {
        view_eye_orbit(&s->eye, s->vertical, -right * turn_of_height, down * turn_of_height);
    }
    view_session_touch(s, true);
}

static void move(struct view_session *s, const SDL_MouseMotionEvent *motion)
{
    const int dx = motion->x - s->from_x, dy = motion->y - s->from_y;
    if (!s->drags || !s->model || (!s->moved && dx * dx + dy * dy < CLICK_PIXELS * CLICK_PIXELS)) {
        return;
    }
    int width, height;
    SDL_GetWindowSize(s->window.window, &width, &height);
    drag(s, (double)dx / height, (double)dy / height);
    s->moved = true;
    s->from_x = motion->x;
    s->from_y = motion->y;
}

// What is open scrolls; else the view zooms.
static void scroll(struct view_session *s, int up)
{
    if (view_session_scroll(s, -WHEEL_LINES * up) || !s->model) {
        return;
    }
    int x, y, pixel_x, pixel_y;
    SDL_GetMouseState(&x, &y);
    view_window_pixel(&s->window, x, y, &pixel_x, &pixel_y);
    const double half = 0.5 * s->window.height, factor = scene_pow(zoom_of_notch, up),
                 seen = view_eye_scale(&s->eye) * factor / s->extent;
    if ((factor < 1.0 && seen < nearest) || (factor > 1.0 && seen > farthest)) {
        return; // the way back is open
    }
    view_eye_zoom(&s->eye, (pixel_x - 0.5 * s->window.width) / half, (half - pixel_y) / half, factor);
    view_session_touch(s, true);
}

static void release(struct view_session *s, const SDL_MouseButtonEvent *button)
{
    int x, y;
    view_window_pixel(&s->window, button->x, button->y, &x, &y);
    const bool clicked = s->drags && !s->moved && button->button == SDL_BUTTON_LEFT && s->model;
    s->drags = s->drags && button->button != s->button;
    if (clicked && x >= 0 && y >= 0 && x < s->window.width && y < s->window.height) {
        view_session_explain(s, x, y);
    }
}

void view_session_mouse(struct view_session *s, const SDL_Event *event)
{
    switch (event->type) {
    case SDL_MOUSEBUTTONDOWN:
        if (!s->drags) {
            s->drags = true;
            s->moved = false;
            s->button = event->button.button;
            s->from_x = event->button.x;
            s->from_y = event->button.y;
        }
        break;
    case SDL_MOUSEBUTTONUP: release(s, &event->button); break;
    case SDL_MOUSEMOTION: move(s, &event->motion); break;
    case SDL_MOUSEWHEEL: scroll(s, event->wheel.y); break;
    default: break;
    }
}
