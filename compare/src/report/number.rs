//! Numbers as a reader wants them: three significant digits, units that fit.

/// Three significant digits; powers of ten outside 0.001..100,000.
#[must_use]
pub fn digits(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 {
        return "0".to_owned();
    }
    if !(1e-3..1e5).contains(&magnitude) {
        return format!("{value:.2e}");
    }
    let before = magnitude.log10().floor() as i32;
    let decimals = (2 - before).max(0) as usize;
    format!("{value:.decimals$}")
}

/// A duration in milliseconds, with the unit that fits.
#[must_use]
pub fn duration(milliseconds: f64) -> String {
    match milliseconds {
        ms if ms >= 60_000.0 => format!("{} min", digits(ms / 60_000.0)),
        ms if ms >= 1000.0 => format!("{} s", digits(ms / 1000.0)),
        ms if ms < 0.1 => format!("{} µs", digits(ms * 1000.0)),
        ms => format!("{} ms", digits(ms)),
    }
}

/// Bytes with a binary unit.
#[must_use]
pub fn bytes(count: u64) -> String {
    match count as f64 {
        n if n >= 1_073_741_824.0 => format!("{} GiB", digits(n / 1_073_741_824.0)),
        n if n >= 1_048_576.0 => format!("{} MiB", digits(n / 1_048_576.0)),
        n if n >= 1024.0 => format!("{} KiB", digits(n / 1024.0)),
        n => format!("{n} B"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits_and_a_fitting_unit() {
        let cases = [(0.0, "0"), (0.012_345, "0.0123"), (12.345, "12.3"), (1234.5, "1234")];
        for (value, text) in cases {
            assert_eq!(digits(value), text);
        }
        assert_eq!(digits(1.5e-7), "1.50e-7");
        assert_eq!(digits(-0.5), "-0.500");
        assert_eq!(duration(0.05), "50.0 µs");
        assert_eq!(duration(90_000.0), "1.50 min");
        assert_eq!(bytes(1 << 20), "1.00 MiB");
    }
}
