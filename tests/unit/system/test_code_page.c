// SPDX-License-Identifier: MIT
// Text in code pages, to its last character, and what is no text of a page.
#include "unit.h"

#include <stdlib.h>

#include "code_page.h"

static void test_the_last_letter_is_kept(void **state)
{
    (void)state;
    // A mark may follow the last letter in the pages of Hebrew and Vietnamese.
    static const struct {
        int page;
        const char *text, *utf8;
    } texts[] = {{1252, "caf\xe9", "caf\xc3\xa9"},
                 {1255, "\xf9\xec\xe5\xed", "\xd7\xa9\xd7\x9c\xd7\x95\xd7\x9d"},
                 {1255, "\xf9\xec\xe5", "\xd7\xa9\xd7\x9c\xd7\x95"},
                 {1258, "bana", "bana"}};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        char *const found = system_code_page_convert(texts[i].page, SYSTEM_CODE_PAGE_UTF8, texts[i].text);
        assert_non_null(found);
        assert_string_equal(found, texts[i].utf8);
        free(found);
    }
}

static void test_what_is_no_text(void **state)
{
    (void)state;
    assert_null(system_code_page_convert(SYSTEM_CODE_PAGE_UTF8, 1252, "\xe2\x98\x83"));
    assert_null(system_code_page_convert(SYSTEM_CODE_PAGE_UTF8, 1252, "\xc3"));
    assert_null(system_code_page_convert(54321, SYSTEM_CODE_PAGE_UTF8, "a"));
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_the_last_letter_is_kept),
    cmocka_unit_test(test_what_is_no_text),
};

const struct unit_tests test_code_page = UNIT_TESTS(tests, NULL, NULL);
