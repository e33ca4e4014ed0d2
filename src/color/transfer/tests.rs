use super::*;
use approx::assert_relative_eq;

/// How far decoding may miss what was encoded: rounding, except where two directions were published rounded.
fn round_trip_tolerance(transfer: Transfer) -> f64 {
    match transfer {
        Transfer::DLog => 2e-5,
        Transfer::AcesProxy10 | Transfer::AcesProxy12 => f64::INFINITY,
        _ => 2e-12,
    }
}

/// By how much two codes may come in the wrong order where the pieces of a published curve do not quite meet.
fn allowed_step_back(transfer: Transfer) -> f64 {
    match transfer {
        Transfer::NLog | Transfer::LLog => 1e-3,
        Transfer::Bt709 | Transfer::Bt2020 | Transfer::Rimm => 6e-5,
        Transfer::DLog | Transfer::FLog | Transfer::Bt2020TwelveBit | Transfer::Smpte240m => 2e-4,
        _ => 1e-6,
    }
}

/// Linear values that every curve has a code of its own for.
fn domain(transfer: Transfer) -> impl Iterator<Item = f64> {
    let least = match transfer {
        Transfer::AcesCc | Transfer::Pq | Transfer::Bt1886 => 0.0,
        Transfer::Cineon | Transfer::RedLogFilm | Transfer::Protune => 0.0,
        Transfer::AppleLog => -0.05,
        Transfer::AcesProxy10 | Transfer::AcesProxy12 => 0.002,
        _ => -0.1,
    };
    (0..4000).map(move |i| least + (16.0 - least) * f64::from(i) / 4000.0)
}

#[test]
fn decoding_undoes_encoding() {
    for name in Transfer::names() {
        let transfer = Transfer::by_name(name).unwrap();
        let tolerance = round_trip_tolerance(transfer);
        for x in domain(transfer) {
            let back = transfer.decode(transfer.encode(x));
            assert!((back - x).abs() <= tolerance * x.abs().max(1.0), "{name}: {x} {back}");
        }
    }
}

#[test]
fn encoding_undoes_decoding() {
    for name in Transfer::names() {
        let transfer = Transfer::by_name(name).unwrap();
        let tolerance = round_trip_tolerance(transfer).max(allowed_step_back(transfer) * 10.0);
        let least = transfer.encode(domain(transfer).next().unwrap());
        for i in 0..=1000 {
            let code = least + (1.0 - least) * f64::from(i) / 1000.0;
            let back = transfer.encode(transfer.decode(code));
            assert!((back - code).abs() <= tolerance, "{name}: {code} {back}");
        }
    }
}

#[test]
fn both_directions_are_monotone() {
    for name in Transfer::names() {
        let transfer = Transfer::by_name(name).unwrap();
        let step_back = allowed_step_back(transfer);
        let codes: Vec<f64> = domain(transfer).map(|x| transfer.encode(x)).collect();
        assert!(codes.windows(2).all(|w| w[1] >= w[0] - step_back), "{name}");
        assert!(codes.last() > codes.first(), "{name}");
        let linear: Vec<f64> = (-100..=1100).map(|i| transfer.decode(f64::from(i) / 1000.0)).collect();
        assert!(linear.windows(2).all(|w| w[1] >= w[0] - step_back), "{name}");
    }
}

#[test]
fn relative_curves_keep_black_and_white() {
    for name in
        ["linear", "gamma-1.8", "srgb", "bt709", "bt2020-exact", "bt1886", "smpte-240m", "romm", "cie-lightness"]
    {
        let transfer = Transfer::by_name(name).unwrap();
        assert_eq!((transfer.encode(0.0), transfer.decode(0.0)), (0.0, 0.0), "{name}");
        assert_relative_eq!(transfer.encode(1.0), 1.0, max_relative = 1e-15);
        assert_relative_eq!(transfer.decode(1.0), 1.0, max_relative = 1e-15);
    }
}

/// Codes that the makers print for 18 % grey.
#[test]
fn grey_has_the_published_codes() {
    for (name, code, digits) in [
        ("acescct", 0.413_588, 1e-6),
        ("acescc", 0.413_588, 1e-6),
        ("logc3", 0.391_007, 1e-6),
        ("logc4", 0.2784, 1e-4),
        ("s-log3", 420.0 / 1023.0, 1e-12),
        ("v-log", 0.4233, 1e-4),
        ("log3g10", 1.0 / 3.0, 1e-6),
        ("davinci-intermediate", 0.336_043, 1e-6),
        ("blackmagic-film-5", 0.383_56, 1e-5),
        ("canon-log3", 0.343_389, 1e-6),
        ("f-log2", 400.0 / 1023.0, 5e-4),
        ("l-log", 0.4353, 1e-4),
        ("apple-log", 0.488_272, 1e-6),
    ] {
        let found = Transfer::by_name(name).unwrap().encode(0.18);
        assert!((found - code).abs() < digits, "{name}: {found}; expected {code}");
    }
}

#[test]
fn srgb_has_the_values_it_always_had() {
    assert_relative_eq!(srgb_encode(0.5), 0.735_356_983_052_449_6, max_relative = 1e-14);
    assert_eq!(srgb_encode(0.2), 1.055 * math::pow(0.2, 1.0 / 2.4) - 0.055);
    assert_eq!(srgb_decode(0.2), math::pow((0.2 + 0.055) / 1.055, 2.4));
    assert_eq!(Transfer::Srgb.encode(0.7), srgb_encode(0.7));
    // Both ends belong to the straight piece.
    assert_eq!((srgb_encode(0.003_130_8), srgb_decode(0.040_45)), (12.92 * 0.003_130_8, 0.040_45 / 12.92));
}

#[test]
fn names_find_what_they_name() {
    for name in Transfer::names() {
        let transfer = Transfer::by_name(name).unwrap();
        assert_eq!(Transfer::by_name(&transfer.name()).unwrap(), transfer, "{name}");
    }
    assert_eq!(Transfer::by_name("gamma-2.35").unwrap(), Transfer::Gamma(2.35));
    assert_eq!(Transfer::Gamma(2.35).name(), "gamma-2.35");
    for bad in ["gamma-0", "gamma--1", "gamma-inf", "gamma-NaN", "slog3"] {
        assert_eq!(Transfer::by_name(bad).unwrap_err().kind, ErrorKind::UnknownName, "{bad}");
    }
    assert_eq!(Transfer::by_name("slog3").unwrap_err().nearest.as_deref(), Some("s-log3"));
}

#[test]
fn exposure_indices_are_those_of_the_table() {
    assert_eq!(ExposureIndex::new(800).unwrap(), ExposureIndex::EI_800);
    for name in Transfer::names() {
        if let (Some(ei), Ok(Transfer::LogC3(index))) = (name.strip_prefix("logc3-ei"), Transfer::by_name(name)) {
            assert_eq!(index, ExposureIndex::new(ei.parse().unwrap()).unwrap());
            assert_eq!(index.value().to_string(), ei);
        }
    }
    assert!(ExposureIndex::new(801).unwrap_err().message.contains("1600"));
}

#[test]
fn every_finite_number_has_a_code_that_is_not_nan() {
    for name in Transfer::names() {
        let transfer = Transfer::by_name(name).unwrap();
        for x in [-1e300, -1.0, -1e-300, -0.0, 0.0, 1e-300, 1.0, 1e300] {
            assert!(!transfer.encode(x).is_nan() && !transfer.decode(x).is_nan(), "{name}: {x}");
        }
    }
}
