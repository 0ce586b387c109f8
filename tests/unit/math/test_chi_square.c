// Chi-square quantiles against values of 40 digits (mpmath, regularised incomplete gamma), and
// what the samples of a pixel need.
#include "test.h"

#include "math/chi_square.h"

static const struct {
    double probability;
    int degrees;
    double value;
} known[] = {
    {0.001, 1, 10.82756617066273},    {0.001, 2, 13.81551055796427},
    {0.001, 9, 27.87716487125657},    {0.001, 100, 149.4492527790387},
    {0.001, 256, 331.6563945454609},  {0.001, 257, 332.792778985352},
    {0.001, 1000, 1143.917092619679}, {0.001, 1000000, 1004375.948746142},
    {0.1, 1, 2.705543454095415},      {0.1, 2, 4.605170185988091},
    {0.1, 9, 14.68365657325984},      {0.1, 100, 118.4980038110621},
    {0.1, 256, 285.3926666691409},    {0.1, 257, 286.449314506985},
    {0.1, 1000, 1057.723901381614},   {0.1, 1000000, 1001812.815315016},
    {0.5, 1, 0.4549364231195728},     {0.5, 2, 1.386294361119891},
    {0.5, 9, 8.342832692252954},      {0.5, 100, 99.33412923598846},
    {0.5, 256, 255.333642856225},     {0.5, 257, 256.3336416484391},
    {0.5, 1000, 999.333412403381},    {0.5, 1000000, 999999.3333334123},
    {0.9, 1, 0.01579077409343122},    {0.9, 2, 0.2107210313156526},
    {0.9, 9, 4.168159008146107},      {0.9, 100, 82.35813581235715},
    {0.9, 256, 227.4636933164209},    {0.9, 257, 228.4070460233793},
    {0.9, 1000, 943.132562342892},    {0.9, 1000000, 998188.0411841684},
    {0.999, 1, 1.57079714926249e-6},  {0.999, 2, 0.002001000667167067},
    {0.999, 9, 1.151949546223564},    {0.999, 100, 61.91793920693662},
    {0.999, 256, 191.7304472643053},  {0.999, 257, 192.5941117019325},
    {0.999, 1000, 867.4790826072769}, {0.999, 1000000, 995635.4506315955},
};

static void known_values(void **state)
{
    (void)state;
    enum { MOST = 1000000 };
    double *table = test_calloc(MOST + 1, sizeof *table);
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        chi_square_table(known[i].probability, known[i].degrees, table);
        const double v = table[known[i].degrees];
        if (!(fabs(v / known[i].value - 1) < 1e-7))
            fail_msg("probability %g, degrees %d: %.17g, not %.17g", known[i].probability,
                     known[i].degrees, v, known[i].value);
    }
    test_free(table);
}

// Sums and expansion meet: steps from one degree to the next change slowly.
static void smooth(void **state)
{
    (void)state;
    enum { MOST = 2000 };
    double table[MOST + 1];
    chi_square_table(0.1, MOST, table);
    assert_true(table[0] == 0);
    for (int k = 101; k < MOST; k++) {
        const double bend = table[k + 1] - 2 * table[k] + table[k - 1];
        assert_true(bend < 0 && bend > -0.001);
    }
}

// The whole variance is allowed where one sample less than all was taken.
static void thresholds(void **state)
{
    (void)state;
    double enough[12];
    chi_square_thresholds(0.9, 0.0078125, 10, 11, enough);
    assert_true(enough[9] == 0.0078125);
    for (int k = 1; k <= 11; k++)
        assert_true(enough[k] > enough[k - 1]);
    chi_square_thresholds(0.9, 0.0078125, 1, 2, enough);
    assert_true(enough[1] == 0 && enough[2] == 0);
    chi_square_thresholds(1, 0.0078125, 10, 11, enough);
    assert_true(enough[11] >= 0 && enough[11] < 1e300);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_values),
        cmocka_unit_test(smooth),
        cmocka_unit_test(thresholds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
