"""Transfer functions: codes, linear values, round trips, displays.

Linear values up to 1 and codes are compared absolutely, larger values relatively: LogC4 decodes 1 to 469, PQ to 10 000.
"""

import colour
import colour.models as m
import numpy as np
from colour.models.rgb.transfer_functions.itur_bt_2020 import CONSTANTS_BT2020_PRECISE
from comparison import Comparison, row

RANDOM = np.random.default_rng(1950)
LINEAR = np.unique(np.concatenate([np.linspace(-0.1, 16.0, 806), 10.0 ** RANDOM.uniform(-9.0, 1.2, 400)]))
CODES = np.unique(np.concatenate([np.linspace(0.0, 1.0, 501), RANDOM.uniform(0.0, 1.0, 300)]))
LUMINANCES = np.unique(np.concatenate([[0.0, 1e4], 10.0 ** RANDOM.uniform(-6.0, 4.0, 800)]))


class Curve:
    """One curve: its name here, both directions by colour-science, where pieces meet, where it is compared."""

    def __init__(self, name, encode, decode, cuts=(), code_cuts=(), linear=LINEAR, round_trip=True):
        self.name, self.encode, self.decode, self.round_trip, self.trip = name, encode, decode, round_trip, linear
        inside = [c for cut in cuts for c in around(cut) if linear.min() <= c <= linear.max()]
        self.linear = np.unique(np.concatenate([linear, inside]))
        self.codes = np.unique(np.concatenate([CODES, [c for cut in code_cuts for c in around(cut)]]))


def around(cut):
    """A cut and the numbers 1 ulp beside it."""
    return np.nextafter(cut, -np.inf), cut, np.nextafter(cut, np.inf)


def with_switch_at(decode, standard, other, low, high):
    """colour's decoder with the standard's switch point: codes between both take the piece that the standard says.

    colour puts the switch of many decoders at what its encoder gives for the linear switch, the standards at a rounded
    number: the codes between differ by up to 6e-5.
    """
    first, last = sorted((standard, other))

    def function(codes):
        between = (codes >= first) & (codes <= last)
        return np.where(between, np.where(codes < standard, low(codes), high(codes)), decode(codes))

    return function


def video(name, encode, decode, alpha, beta):
    other = float(encode(beta))
    high = lambda v: ((v + (alpha - 1.0)) / alpha) ** (1.0 / 0.45)
    decode = with_switch_at(decode, 4.5 * beta, other, lambda v: v / 4.5, high)
    return Curve(name, encode, decode, [beta], [4.5 * beta, other])


def srgb_decode(codes):
    # colour switches at 12.92 times 0.0031308, IEC 61966-2-1 and we at 0.04045.
    between = (codes > 12.92 * 0.0031308) & (codes <= 0.04045)
    return np.where(between, codes / 12.92, m.eotf_sRGB(codes))


def video_curves():
    exact = {"constants": CONSTANTS_BT2020_PRECISE}
    alpha, beta = CONSTANTS_BT2020_PRECISE.alpha(False), CONSTANTS_BT2020_PRECISE.beta(False)
    return [
        Curve("srgb", m.eotf_inverse_sRGB, srgb_decode, [0.0031308], [12.92 * 0.0031308, 0.04045]),
        video("bt601", m.oetf_BT601, m.oetf_inverse_BT601, 1.099, 0.018),
        video("bt709", m.oetf_BT709, m.oetf_inverse_BT709, 1.099, 0.018),
        video("bt2020", m.oetf_BT2020, m.oetf_inverse_BT2020, 1.099, 0.018),
        twelve_bit(),
        video("bt2020-exact", lambda x: m.oetf_BT2020(x, **exact), lambda v: m.oetf_inverse_BT2020(v, **exact), alpha, beta),
        Curve("smpte-240m", m.oetf_SMPTE240M, m.eotf_SMPTE240M, [0.0228], [0.0913]),
        # The inverse of the ideal display is defined from 0 on; colour mirrors it, we have one code for all below.
        Curve("bt1886", m.eotf_inverse_BT1886, m.eotf_BT1886, linear=LINEAR[LINEAR >= 0.0]),
    ]


def twelve_bit():
    """colour's 12-bit decoder takes its switch from the 10-bit encoder; the standard's is 4.5 times 0.0181."""
    encode = lambda x: m.oetf_BT2020(x, True)
    decode = lambda v: m.oetf_inverse_BT2020(v, True)
    high = lambda v: ((v + 0.0993) / 1.0993) ** (1.0 / 0.45)
    decode = with_switch_at(decode, 4.5 * 0.0181, float(m.oetf_BT2020(0.0181)), lambda v: v / 4.5, high)
    return Curve("bt2020-12bit", encode, decode, [0.0181], [4.5 * 0.0181])


def gamma_curves():
    mirrored = lambda exponent: lambda x: m.gamma_function(x, exponent, "Mirror")
    named = [(f"gamma-{g}", float(g)) for g in ("1.8", "2.0", "2.2", "2.4", "2.6", "2.8", "2.35")] + [("adobe-rgb", 563 / 256)]
    curves = [Curve(name, mirrored(1.0 / g), mirrored(g)) for name, g in named]
    return curves + [Curve("linear", m.linear_function, m.linear_function)]


def still_curves():
    positive = LINEAR[LINEAR >= 0.0]
    v_clip = 1.099 * 2.0**0.45 - 0.099
    # RIMM's decoder switches at the code of the straight piece, as BT.709's does.
    rimm_decode = with_switch_at(
        m.cctf_decoding_RIMMRGB,
        0.081 / v_clip,
        float(m.cctf_encoding_RIMMRGB(0.018)),
        lambda v: v * v_clip / 4.5,
        lambda v: ((v * v_clip + 0.099) / 1.099) ** (1.0 / 0.45),
    )
    e_cut = np.e * 0.001
    return [
        Curve("romm", m.cctf_encoding_ROMMRGB, m.cctf_decoding_ROMMRGB, [2.0**-9], [2.0**-5]),
        # colour has one code for black and everything below in RIMM and ERIMM; we go on with the straight piece.
        Curve("rimm", m.cctf_encoding_RIMMRGB, rimm_decode, [0.018], [0.081 / v_clip], linear=positive),
        Curve("erimm", m.log_encoding_ERIMMRGB, m.log_decoding_ERIMMRGB, [e_cut], [1.0 / np.log(316200.0)], linear=positive),
        Curve("dcdm", m.eotf_inverse_DCDM, m.eotf_DCDM),
        Curve(
            "cie-lightness",
            lambda y: colour.colorimetry.lightness_CIE1976(100.0 * y) / 100.0,
            lambda l: colour.colorimetry.luminance_CIE1976(100.0 * l) / 100.0,
            [(6 / 29) ** 3],
            [0.08],
        ),
    ]


def hdr_curves():
    return [
        # ST 2084 has no negative luminances; colour mirrors inside the formula, we have one code for all below.
        Curve("pq", m.eotf_inverse_ST2084, m.eotf_ST2084, linear=LUMINANCES),
        Curve("hlg", m.oetf_BT2100_HLG, m.oetf_inverse_BT2100_HLG, [1 / 12], [0.5]),
    ]


def aces_curves():
    # Everything below 2^-16.6 has the code of black or nearly so: the toe of ACEScc is flat there.
    positive = LINEAR[LINEAR >= 0.0]
    proxy = lambda bits: (lambda x: m.log_encoding_ACESproxy(x, bits), lambda v: m.log_decoding_ACESproxy(v, bits))
    return [
        Curve("acescc", m.log_encoding_ACEScc, m.log_decoding_ACEScc, [0.0, 2.0**-15], [(9.72 - 15) / 17.52], round_trip=False),
        Curve("acescc", m.log_encoding_ACEScc, m.log_decoding_ACEScc, [2.0**-15], linear=positive),
        Curve("acescct", m.log_encoding_ACEScct, m.log_decoding_ACEScct, [2.0**-7], [0.155251141552511]),
        Curve("acesproxy-10", *proxy(10), [2.0**-9.72], round_trip=False),
        Curve("acesproxy-12", *proxy(12), [2.0**-9.72], round_trip=False),
    ]


def arri_curves():
    table = colour.models.rgb.transfer_functions.arri.DATA_ALEXA_LOG_C_CURVE_CONVERSION
    curves = []
    for ei, (cut, *_, e, f, _) in table["SUP 3.x"]["Linear Scene Exposure Factor"].items():
        encode = lambda x, ei=ei: m.log_encoding_ARRILogC3(x, EI=ei)
        decode = lambda v, ei=ei: m.log_decoding_ARRILogC3(v, EI=ei)
        name = "logc3" if ei == 800 else f"logc3-ei{ei}"
        curves.append(Curve(name, encode, decode, [cut], [e * cut + f]))
    t = colour.models.CONSTANTS_ARRILOGC4.t if hasattr(colour.models, "CONSTANTS_ARRILOGC4") else -0.01805699611991131
    return curves + [Curve("logc4", m.log_encoding_ARRILogC4, m.log_decoding_ARRILogC4, [t], [0.0])]


def sony_curves():
    return [
        Curve("s-log", m.log_encoding_SLog, m.log_decoding_SLog, [0.0]),
        Curve("s-log2", m.log_encoding_SLog2, m.log_decoding_SLog2, [0.0]),
        Curve("s-log3", m.log_encoding_SLog3, m.log_decoding_SLog3, [0.01125], [171.2102946929 / 1023]),
    ]


def camera_curves():
    film_end = LINEAR[LINEAR >= 0.0]
    apple_log = m.log_encoding_AppleLogProfile, m.log_decoding_AppleLogProfile
    return [
        Curve("v-log", m.log_encoding_VLog, m.log_decoding_VLog, [0.01], [0.181]),
        Curve("log3g10", m.log_encoding_Log3G10, m.log_decoding_Log3G10, [-0.01], [0.0]),
        Curve("red-log-film", m.log_encoding_REDLogFilm, m.log_decoding_REDLogFilm, linear=film_end),
        Curve("cineon", m.log_encoding_Cineon, m.log_decoding_Cineon, linear=film_end),
        Curve("canon-log", m.log_encoding_CanonLog, m.log_decoding_CanonLog, [0.0], [0.12512248]),
        Curve("canon-log2", m.log_encoding_CanonLog2, m.log_decoding_CanonLog2, [0.0], [0.092864125]),
        Curve("canon-log3", m.log_encoding_CanonLog3, m.log_decoding_CanonLog3, [], [0.097465473, 0.15277891]),
        Curve("f-log", m.log_encoding_FLog, m.log_decoding_FLog, [0.00089], [0.100537775223865]),
        Curve("f-log2", m.log_encoding_FLog2, m.log_decoding_FLog2, [0.000889], [0.100686685370811]),
        Curve("n-log", m.log_encoding_NLog, m.log_decoding_NLog, [0.328], [452 / 1023]),
        # The pieces of L-Log overlap by 9e-4 in code: 1.1e-4 below the cut do not come back.
        Curve("l-log", m.log_encoding_LLog, m.log_decoding_LLog, [0.006], [0.138], round_trip=False),
        Curve("d-log", m.log_encoding_DJIDLog, m.log_decoding_DJIDLog, [0.0078], [0.14], round_trip=False),
        Curve("protune", m.log_encoding_Protune, m.log_decoding_Protune, linear=film_end),
        # One code for everything below -0.0564.
        Curve("apple-log", *apple_log, [0.01, -0.05641088], round_trip=False),
        Curve("apple-log", *apple_log, linear=LINEAR[LINEAR >= -0.0564]),
        Curve("davinci-intermediate", m.oetf_DaVinciIntermediate, m.oetf_inverse_DaVinciIntermediate, [0.00262409], [0.02740668]),
        Curve("blackmagic-film-5", m.oetf_BlackmagicFilmGeneration5, m.oetf_inverse_BlackmagicFilmGeneration5, [0.005]),
        Curve("t-log", m.log_encoding_FilmLightTLog, m.log_decoding_FilmLightTLog, [0.0], [0.075]),
    ]


FAMILIES = {
    "video": video_curves,
    "gammas": gamma_curves,
    "stills and cinema": still_curves,
    "PQ and HLG": hdr_curves,
    "ACES": aces_curves,
    "ARRI": arri_curves,
    "Sony": sony_curves,
    "cameras": camera_curves,
}


def comparisons():
    result = []
    for family, curves in FAMILIES.items():
        curves = curves()
        encoded = [(c.name, x, y) for c in curves for x, y in zip(c.linear, c.encode(c.linear))]
        decoded = [(c.name, x, y) for c in curves for x, y in zip(c.codes, c.decode(c.codes))]
        # Not at the cuts: there the standards' rounding, up to 1e-4, is all that is left.
        trips = [(c.name, x, x) for c in curves if c.round_trip for x in c.trip]
        result += by_size(f"transfer, {family}: encoding", "transfer_encode", encoded)
        result += by_size(f"transfer, {family}: decoding", "transfer_decode", decoded)
        result += by_size(f"transfer, {family}: round trip", "transfer_round_trip", trips)
    return result + displays()


def by_size(subject, function, cases, tolerance=1e-12):
    """Up to two comparisons: absolute where 1 or less is expected, relative above."""
    result = []
    for relative in (False, True):
        chosen = [(name, x, y) for name, x, y in cases if (abs(y) > 1.0) == relative]
        if chosen:
            arguments = [[name, float(x)] for name, x, _ in chosen]
            suffix = " above 1, relative" if relative else ""
            result.append(Comparison(subject + suffix, function, arguments, [float(y) for *_, y in chosen], tolerance, relative, 48))
    return result


def displays():
    signals = [[float(v) for v in rgb] for rgb in [[0.0] * 3, [1.0] * 3, [0.5, 0.5, 0.5], *RANDOM.uniform(0.0, 1.0, (300, 3))]]
    settings = [(0.0, 1000.0), (0.005, 1000.0), (0.1, 400.0), (0.0001, 4000.0)]
    hlg = [[*setting, signal] for setting in settings for signal in signals]
    shown = [m.eotf_BT2100_HLG(np.asarray(s), b, w) for b, w, s in hlg]
    back = [[b, w, [float(v) for v in f]] for (b, w, _), f in zip(hlg, shown)]
    signal_of = [m.eotf_inverse_BT2100_HLG(np.asarray(f), b, w) for b, w, f in back]
    video = [[b, w, float(v)] for b, w in ((0.0, 100.0), (0.05, 100.0), (0.01, 203.0)) for v in np.linspace(0.0, 1.0, 101)]
    luminance = [m.eotf_BT1886(v, b, w) for b, w, v in video]
    inverse = [[b, w, float(l)] for (b, w, _), l in zip(video, luminance)]
    scene = [float(x) for x in LINEAR[(LINEAR >= 0.0) & (LINEAR <= 1.0)]]
    look = [float(x) for x in m.ootf_BT2100_PQ(np.asarray(scene))]
    # colour's inverse of the BT.709 part switches elsewhere (see with_switch_at): codes between are left out.
    known = [f for f in look if not 0.0805 <= (f / 100.0) ** (1 / 2.4) <= 0.0815]
    return [
        Comparison("HLG displays, cd/m2, relative", "hlg_display", hlg, shown, 1e-12, True),
        Comparison("HLG displays, inverse", "hlg_display_inverse", back, signal_of, 1e-12),
        Comparison("BT.1886 displays, cd/m2", "bt1886_display", video, luminance, 1e-11),
        Comparison("BT.1886 displays, inverse", "bt1886_display_inverse", inverse, [m.eotf_inverse_BT1886(l, b, w) for b, w, l in inverse], 1e-12),
        Comparison("PQ scene to display, cd/m2, relative", "pq_ootf", scene[1:], look[1:], 1e-12, True),
        Comparison("PQ display to scene", "pq_ootf_inverse", known, [float(x) for x in m.ootf_inverse_BT2100_PQ(np.asarray(known))], 1e-12),
    ]


def checks(evaluate):
    names = set(evaluate("transfer_names", [None])[0])
    compared = {curve.name for curves in FAMILIES.values() for curve in curves()} - {"gamma-2.35"}
    return [row("transfer functions without a comparison", len(names), len(names ^ compared), 0)]
