/// @file agx.h
/// The numbers of the tone curve, for C and for shaders alike: AgX (Sobotka 2022) in the polynomial
/// form of Wrensch 2023, Minimal AgX Implementation. Matrices row by row. Private to render and
/// studio.
#pragma once

#define FR_AGX_INSET                                                                               \
    0.842479062253094f, 0.0784335999999992f, 0.0792237451477643f, 0.0423282422610123f,             \
        0.878468636469772f, 0.0791661274605434f, 0.0423756549057051f, 0.0784336f,                  \
        0.879142973793104f
#define FR_AGX_OUTSET                                                                              \
    1.19687900512017f, -0.0980208811401368f, -0.0990297440797205f, -0.0528968517574562f,           \
        1.15190312990417f, -0.0989611768448433f, -0.0529716355144438f, -0.0980434501171241f,       \
        1.15107367264116f
/// Exposure of the curve in stops about mid grey.
#define FR_AGX_LOWEST -12.47393f
#define FR_AGX_HIGHEST 4.026069f
/// The look on top: a little more contrast and colour than the neutral curve has.
#define FR_AGX_POWER 1.3f
#define FR_AGX_SATURATION 1.27f
/// The curve at x from its powers.
#define FR_AGX_CURVE(x, x2, x4)                                                                    \
    15.5f * x4 *x2 - 40.14f * x4 *x + 31.96f * x4 - 6.868f * x2 *x + 0.4298f * x2 + 0.1191f * x -  \
        0.00232f
