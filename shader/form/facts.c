// SPDX-License-Identifier: MIT
// What the builder knows of homes, so that a load of what was just stored is the value itself.
#include "build.h"

void shader_add_facts_of_home(struct shader_builder *builder, uint32_t home)
{
    struct shader_facts *const facts = &builder->facts;
    while (home >= facts->room) {
        const size_t old = facts->room;
        facts->known = shader_grow(builder->memory, facts->known, &facts->room, sizeof *facts->known);
        for (size_t i = old; i < facts->room; i++) {
            facts->known[i] = SHADER_NO_VALUE;
        }
    }
}

// Change a fact without logging it.
static void put(struct shader_builder *builder, uint32_t home, uint32_t value)
{
    struct shader_facts *const facts = &builder->facts;
    if (facts->known[home] == SHADER_NO_VALUE && value != SHADER_NO_VALUE) {
        if (facts->home_count == facts->home_room) {
            facts->homes =
                shader_grow(builder->memory, facts->homes, &facts->home_room, sizeof *facts->homes);
        }
        facts->homes[facts->home_count++] = home;
    }
    facts->known[home] = value;
}

void shader_learn(struct shader_builder *builder, uint32_t home, uint32_t value)
{
    struct shader_facts *const facts = &builder->facts;
    if (facts->known[home] == value) {
        return;
    }
    if (facts->log_count == facts->log_room) {
        facts->log = shader_grow(builder->memory, facts->log, &facts->log_room, sizeof *facts->log);
    }
    facts->log[facts->log_count++] = (struct shader_fact_change){home, facts->known[home]};
    put(builder, home, value);
}

void shader_forget_all(struct shader_builder *builder)
{
    struct shader_facts *const facts = &builder->facts;
    for (size_t i = 0; i < facts->home_count; i++) {
        shader_learn(builder, facts->homes[i], SHADER_NO_VALUE);
    }
    facts->home_count = 0;
}

void shader_rewind_facts(struct shader_builder *builder, size_t mark)
{
    const struct shader_facts *const facts = &builder->facts;
    for (size_t i = facts->log_count; i > mark; i--) {
        put(builder, facts->log[i - 1].home, facts->log[i - 1].before);
    }
}

void shader_forget_since(struct shader_builder *builder, size_t mark)
{
    const size_t end = builder->facts.log_count;
    for (size_t i = mark; i < end; i++) {
        shader_learn(builder, builder->facts.log[i].home, SHADER_NO_VALUE);
    }
}
