// Functions of the C library, by those of JavaScript: the library's, with their tables, would be a tenth of a module.
// Browsers compile a call of an imported Math.log, for example, as a call of their own C function.
#define ROWLAND_BY_JAVASCRIPT(name)                                                              \
    __attribute__((import_module("Math"), import_name(#name))) double javascript_##name(double); \
    double name(double x) {                                                                      \
        return javascript_##name(x);                                                             \
    }
#define ROWLAND_BY_JAVASCRIPT_OF_TWO(name)                                                               \
    __attribute__((import_module("Math"), import_name(#name))) double javascript_##name(double, double); \
    double name(double x, double y) {                                                                    \
        return javascript_##name(x, y);                                                                  \
    }

extern "C" {

ROWLAND_BY_JAVASCRIPT(acos)
ROWLAND_BY_JAVASCRIPT(asin)
ROWLAND_BY_JAVASCRIPT(atan)
ROWLAND_BY_JAVASCRIPT(cos)
ROWLAND_BY_JAVASCRIPT(exp)
ROWLAND_BY_JAVASCRIPT(expm1)
ROWLAND_BY_JAVASCRIPT(log)
ROWLAND_BY_JAVASCRIPT(log2)
ROWLAND_BY_JAVASCRIPT(sin)
ROWLAND_BY_JAVASCRIPT(tan)
ROWLAND_BY_JAVASCRIPT_OF_TWO(atan2)
ROWLAND_BY_JAVASCRIPT_OF_TWO(pow)

double exp2(double x) {
    return javascript_pow(2.0, x);
}
}
