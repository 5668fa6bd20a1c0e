// SPDX-License-Identifier: MIT
// Owners of what rhw creates, for C++17: each is moved, not copied, and destroys its own; failure is an exception.
// Declare the context before the handles: what is declared last is destroyed first.
#pragma once

#include <memory>
#include <stdexcept>
#include <utility>

#include <rhw/rhw.h>

namespace handles {

inline void must(rhw_result result)
{
    if (result != RHW_OK) {
        throw std::runtime_error(rhw_result_string(result));
    }
}

struct context_end {
    void operator()(rhw_context *context) const noexcept { rhw_context_destroy(context); }
};
using context = std::unique_ptr<rhw_context, context_end>;

inline context make_context(const rhw_context_def &def = {})
{
    rhw_context *made = nullptr;
    must(rhw_context_create(&def, &made));
    return context(made);
}

inline auto create(rhw_context *c, const rhw_buffer_def *def, rhw_buffer *id) { return rhw_buffer_create(c, def, id); }
inline auto create(rhw_context *c, const rhw_texture_def *def, rhw_texture *id) { return rhw_texture_create(c, def, id); }
inline auto create(rhw_context *c, const rhw_sampler_def *def, rhw_sampler *id) { return rhw_sampler_create(c, def, id); }
inline auto create(rhw_context *c, const rhw_pipeline_def *def, rhw_pipeline *id) { return rhw_pipeline_create(c, def, id); }
inline void destroy(rhw_context *c, rhw_buffer id) { rhw_buffer_destroy(c, id); }
inline void destroy(rhw_context *c, rhw_texture id) { rhw_texture_destroy(c, id); }
inline void destroy(rhw_context *c, rhw_sampler id) { rhw_sampler_destroy(c, id); }
inline void destroy(rhw_context *c, rhw_pipeline id) { rhw_pipeline_destroy(c, id); }

template <typename Id, typename Def> class handle {
public:
    handle(const context &owner, const Def &def) { must(create(owner.get(), &def, &id_)); owner_ = owner.get(); }
    handle(handle &&other) noexcept : owner_(std::exchange(other.owner_, nullptr)), id_(other.id_) {}
    handle &operator=(handle &&other) noexcept { std::swap(owner_, other.owner_); std::swap(id_, other.id_); return *this; }
    ~handle() { if (owner_) destroy(owner_, id_); }
    Id id() const noexcept { return id_; }

private:
    rhw_context *owner_ = nullptr;
    Id id_ = {};
};
using buffer = handle<rhw_buffer, rhw_buffer_def>;
using texture = handle<rhw_texture, rhw_texture_def>;
using sampler = handle<rhw_sampler, rhw_sampler_def>;
using pipeline = handle<rhw_pipeline, rhw_pipeline_def>;

} // namespace handles
