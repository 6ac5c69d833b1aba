// Limits: names, values, messages, and counts that cannot wrap.
#include "frond/limits.h"

#include <string.h>

static void test_defaults(void) {
    FrLimits limits = fr_limits_default();
    g_assert_cmpuint(limits.document_bytes, ==, 64000000);
    g_assert_cmpuint(limits.nesting, ==, 64);
    g_assert_cmpuint(limits.bytes, ==, UINT64_C(16000000000));
}

static void test_set(void) {
    FrLimits limits = fr_limits_default();
    g_assert_cmpint(fr_limits_set(&limits, "nodes", "12", NULL), ==, FR_OK);
    g_assert_cmpuint(limits.nodes, ==, 12);
    g_assert_cmpint(fr_limits_set(&limits, "document-bytes", "18446744073709551615", NULL), ==,
                    FR_OK);
    g_assert_cmpuint(limits.document_bytes, ==, UINT64_MAX);
    g_assert_cmpuint(limits.organs, ==, fr_limits_default().organs);
}

static void check_usage_error(const char *name, const char *value, const char *code,
                              const char *part) {
    FrLimits limits = fr_limits_default(), before = limits;
    FrDiags *diags = fr_diags_new();
    g_assert_cmpint(fr_limits_set(&limits, name, value, diags), ==, FR_ERR_USAGE);
    g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, code);
    g_assert_nonnull(strstr(fr_diags_get(diags, 0)->text, part));
    g_assert_true(memcmp(&limits, &before, sizeof before) == 0);
    fr_diags_free(diags);
}

static void test_set_wrong(void) {
    check_usage_error("nods", "1", "unknown-limit", "did you mean 'nodes'");
    check_usage_error("zzzzzz", "1", "unknown-limit", "'zzzzzz'");
    check_usage_error("nodes", "", "limit-value", "whole number");
    check_usage_error("nodes", "-1", "limit-value", "'-1'");
    check_usage_error("nodes", "1e9", "limit-value", "'1e9'");
    check_usage_error("nodes", "99999999999999999999", "limit-value", "nodes");
}

static void test_check(void) {
    FrDiags *diags = fr_diags_new();
    g_assert_cmpint(fr_limit_check(10, 10, "nodes", "trunk", (FrSpan){0}, diags), ==, FR_OK);
    g_assert_cmpuint(fr_diags_count(diags), ==, 0);
    g_assert_cmpint(fr_limit_check(11, 10, "nodes", "trunk", (FrSpan){0}, diags), ==, FR_ERR_LIMIT);
    const FrDiag *diag = fr_diags_get(diags, 0);
    g_assert_cmpstr(diag->code, ==, "limit-nodes");
    g_assert_cmpstr(diag->text, ==,
                    "trunk asks for 11; the limit 'nodes' (internodes of one plant) is 10");
    g_assert_cmpint(fr_limit_check(UINT64_MAX, 10, "nodes", NULL, (FrSpan){0}, diags), ==,
                    FR_ERR_LIMIT);
    g_assert_nonnull(strstr(fr_diags_get(diags, 1)->text, "over 10^19"));
    fr_diags_free(diags);
}

static void test_saturation(void) {
    g_assert_cmpuint(fr_count_add(2, 3), ==, 5);
    g_assert_cmpuint(fr_count_add(UINT64_MAX - 1, 1), ==, UINT64_MAX);
    g_assert_cmpuint(fr_count_add(UINT64_MAX, 1), ==, UINT64_MAX);
    g_assert_cmpuint(fr_count_multiply(1000, 1000), ==, 1000000);
    g_assert_cmpuint(fr_count_multiply(UINT64_C(1) << 32, UINT64_C(1) << 32), ==, UINT64_MAX);
    g_assert_cmpuint(fr_count_multiply(UINT64_MAX, 0), ==, 0);
    g_assert_cmpuint(fr_count_multiply(0, UINT64_MAX), ==, 0);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/base/limits/defaults come from the table", test_defaults);
    g_test_add_func("/base/limits/one limit is set by name", test_set);
    g_test_add_func("/base/limits/a wrong name or value changes nothing", test_set_wrong);
    g_test_add_func("/base/limits/the error names the limit, its value and who asked", test_check);
    g_test_add_func("/base/limits/counts stop at the largest number", test_saturation);
    return g_test_run();
}
