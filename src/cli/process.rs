//! Facts about the running process.

use std::io::Read;

/// A processor feature that this build needs and the machine lacks.
///
/// Builds with this repository's settings use x86-64-v3; asking the processor through the standard library is answered
/// at compile time in such a build, so the kernel is asked.
pub fn missing_processor_feature() -> Option<&'static str> {
    if !cfg!(target_feature = "avx2") {
        return None;
    }
    let mut text = [0u8; 8192];
    let mut file = std::fs::File::open("/proc/cpuinfo").ok()?;
    let length = file.read(&mut text).ok()?;
    let text = String::from_utf8_lossy(&text[..length]);
    let flags = text.lines().find(|line| line.starts_with("flags"))?;
    ["avx2", "bmi2", "fma"].into_iter().find(|feature| !flags.split_whitespace().any(|flag| flag == *feature))
}

/// Processor time of all threads so far, seconds; `None` where the system does not tell.
pub fn cpu_seconds() -> Option<f64> {
    ticks([11, 12])
}

/// Processor time of all child processes that have ended and been waited for, and of theirs, seconds.
pub fn children_cpu_seconds() -> Option<f64> {
    ticks([13, 14])
}

/// The sum of two fields of /proc/self/stat, counted from the one after the command's name, in seconds.
fn ticks(fields: [usize; 2]) -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The second field is the command's name in parentheses and may hold spaces.
    let all: Vec<&str> = text.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks: f64 = fields.into_iter().map(|i| all.get(i).and_then(|f| f.parse::<f64>().ok())).sum::<Option<_>>()?;
    const TICKS_PER_SECOND: f64 = 100.0;
    Some(ticks / TICKS_PER_SECOND)
}

/// Largest resident memory so far, bytes; `None` where the system does not tell.
pub fn peak_memory_bytes() -> Option<u64> {
    peak_memory_bytes_of("self")
}

fn peak_memory_bytes_of(process: &str) -> Option<u64> {
    let text = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = text.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse::<u64>().ok().map(|kilobytes| kilobytes * 1024)
}

/// The largest resident memory so far of any process that descends from one, itself included.
pub fn peak_memory_bytes_of_tree(process: u32) -> Option<u64> {
    let mut peak = peak_memory_bytes_of(&process.to_string());
    let children = std::fs::read_to_string(format!("/proc/{process}/task/{process}/children")).unwrap_or_default();
    for child in children.split_whitespace().filter_map(|id| id.parse().ok()) {
        peak = peak.max(peak_memory_bytes_of_tree(child));
    }
    peak
}

/// Lets [`peak_memory_bytes`] count anew, where the system can.
pub fn reset_peak_memory() {
    // Where it cannot, the peak is that since the start.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}

/// Memory that could still be had, bytes; `None` where the system does not tell.
pub fn available_memory_bytes() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("MemAvailable:"))?;
    line.split_whitespace().nth(1)?.parse::<u64>().ok().map(|kilobytes| kilobytes * 1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(target_os = "linux")]
    #[test]
    fn linux_tells() {
        assert!(cpu_seconds().is_some_and(|s| (0.0..1e6).contains(&s)));
        assert!(children_cpu_seconds().is_some_and(|s| (0.0..1e6).contains(&s)));
        assert!(peak_memory_bytes_of_tree(std::process::id()).is_some_and(|b| b > 1 << 20));
        assert!(peak_memory_bytes().is_some_and(|b| b > 1 << 20));
        assert!(available_memory_bytes().is_some_and(|b| b > 1 << 20));
        assert_eq!(missing_processor_feature(), None);
    }
}
