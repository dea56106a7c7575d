//! Limits on the files that a command reads, and the default of `--max-memory`.
//!
//! The default is a quarter of the memory that the machine has for this process. On Linux that is the least of the physical
//! memory (`/proc/meminfo`), the limits of the process's control groups, version 1 and 2, and its limit on address space
//! (`ulimit -v`). Other systems report it only through a system call, so the readers' default applies there.

use super::values;
use crate::report::Reporter;
use clap::Args;
use gonio_mesh::Limits;
use gonio_mesh::input::DEFAULT_MAX_BYTES;
use gonio_scene::files::{Budgeted, DiskAndInput, FileSource, Sandbox};
use std::path::{Path, PathBuf};

/// Limits on what a file may make gonio allocate.
#[derive(Args, Debug, Clone, Default)]
#[command(next_help_heading = "Limit options")]
pub struct LimitOptions {
    /// Reject models with more triangles.
    #[arg(long, value_name = "N")]
    pub max_triangles: Option<u64>,
    /// Reject inputs that need more memory, for example 512MiB; by default a quarter of the machine's.
    ///
    /// Counts an input together with all files that it names, unpacked and decoded.
    #[arg(long, value_name = "SIZE", value_parser = values::bytes)]
    pub max_memory: Option<u64>,
    /// Read only files in the folders of the inputs.
    ///
    /// Models and scenes cannot name files elsewhere, neither by `..` nor by absolute paths or links.
    #[arg(long)]
    pub sandbox: bool,
}

impl LimitOptions {
    /// The default limits, with those of the options in their place.
    pub fn limits(&self) -> Limits {
        let usual = Limits::default();
        Limits {
            max_triangles: self.max_triangles.map_or(usual.max_triangles, |most| most.min(usual.max_triangles)),
            max_bytes: self.max_memory.unwrap_or_else(default_limit),
            ..usual
        }
    }

    /// The files that a command reads for what the user names: models, scenes, environments.
    pub fn files<'i>(&self, named: impl IntoIterator<Item = &'i str>, reporter: &Reporter) -> Box<dyn FileSource> {
        let named: Vec<&str> = named.into_iter().collect();
        let disk = reporter.reporting_reads(DiskAndInput::new(named.iter().copied()));
        let files: Box<dyn FileSource> =
            if self.sandbox { Box::new(Sandbox::new(disk, named)) } else { Box::new(disk) };
        Box::new(Budgeted::new(files, self.limits().max_bytes))
    }
}

/// The divisor of the machine's memory. Pictures and meshes made from an input take as much again, and other programs run too.
const SHARE: u64 = 4;

/// The bytes that an input may take by default.
pub fn default_limit() -> u64 {
    machine_memory(&|path| std::fs::read_to_string(path).ok()).map_or(DEFAULT_MAX_BYTES, |bytes| bytes / SHARE)
}

/// The memory for this process according to files of the system; `None` if they do not exist.
fn machine_memory(read: &dyn Fn(&Path) -> Option<String>) -> Option<u64> {
    let physical = read(Path::new("/proc/meminfo")).and_then(|text| kilobytes(&text, "MemTotal:"));
    let groups = read(Path::new("/proc/self/cgroup")).and_then(|text| group_limit(&text, read));
    let address_space = read(Path::new("/proc/self/limits")).and_then(|text| address_space_limit(&text));
    [physical, groups, address_space].into_iter().flatten().min()
}

/// The number of a line `KEY   16384 kB`, in bytes.
fn kilobytes(text: &str, key: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(key))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1 << 10)
}

/// The soft limit in the line `Max address space   SOFT   HARD   bytes`; `None` if it is unlimited.
fn address_space_limit(text: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    line.split_whitespace().next()?.parse().ok()
}

/// The least limit of the groups that `/proc/self/cgroup` lists, one per line `ID:CONTROLLERS:PATH`, and of their parents, whose
/// limits apply too.
fn group_limit(text: &str, read: &dyn Fn(&Path) -> Option<String>) -> Option<u64> {
    let limits = text.lines().filter_map(|line| {
        let mut fields = line.splitn(3, ':');
        let (_, controllers, path) = (fields.next()?, fields.next()?, fields.next()?);
        let (mount, file) = match controllers {
            "" => ("/sys/fs/cgroup", "memory.max"),
            _ if controllers.split(',').any(|name| name == "memory") => {
                ("/sys/fs/cgroup/memory", "memory.limit_in_bytes")
            }
            _ => return None,
        };
        // In a container this may be the path outside the container, of which only the root is visible.
        let group = PathBuf::from(path.trim_start_matches('/'));
        let limit = |group: &Path| read(&Path::new(mount).join(group).join(file))?.trim().parse::<u64>().ok();
        group.ancestors().filter_map(limit).min()
    });
    limits.min()
}

#[cfg(test)]
mod tests {
    use super::*;

    const MEMINFO: &str = "MemTotal:       16777216 kB\nMemFree:         1000 kB\n";
    const UNLIMITED: &str =
        "Limit  Soft Limit  Hard Limit  Units\nMax address space    unlimited   unlimited   bytes\n";

    fn memory_with(files: &[(&str, &str)]) -> Option<u64> {
        machine_memory(&|path| {
            files.iter().find(|(known, _)| Path::new(known) == path).map(|(_, text)| (*text).to_owned())
        })
    }

    #[test]
    fn physical_memory_alone() {
        assert_eq!(memory_with(&[("/proc/meminfo", MEMINFO), ("/proc/self/limits", UNLIMITED)]), Some(16 << 30));
        assert_eq!(memory_with(&[]), None);
        assert_eq!(memory_with(&[("/proc/meminfo", "MemTotal: much kB")]), None);
    }

    #[test]
    fn groups_of_version_2_and_those_around_them() {
        let group = ("/proc/self/cgroup", "0::/user/shell\n");
        let own = ("/sys/fs/cgroup/user/shell/memory.max", "max\n");
        let around = ("/sys/fs/cgroup/user/memory.max", "1073741824\n");
        assert_eq!(memory_with(&[("/proc/meminfo", MEMINFO), group, own]), Some(16 << 30));
        assert_eq!(memory_with(&[("/proc/meminfo", MEMINFO), group, own, around]), Some(1 << 30));
        // A container sees its own group as the root.
        let root = ("/sys/fs/cgroup/memory.max", "536870912\n");
        assert_eq!(memory_with(&[("/proc/meminfo", MEMINFO), ("/proc/self/cgroup", "0::/\n"), root]), Some(512 << 20));
    }

    #[test]
    fn groups_of_version_1() {
        let groups = ("/proc/self/cgroup", "11:cpu,cpuacct:/a\n9:memory:/docker/abc\n0::/docker/abc\n");
        let seen = ("/sys/fs/cgroup/memory/memory.limit_in_bytes", "2147483648\n");
        assert_eq!(memory_with(&[("/proc/meminfo", MEMINFO), groups, seen]), Some(2 << 30));
        let none = ("/sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
        assert_eq!(memory_with(&[("/proc/meminfo", MEMINFO), groups, none]), Some(16 << 30));
    }

    #[test]
    fn a_limit_on_address_space() {
        let limits = ("/proc/self/limits", "Max address space         4294967296           unlimited   bytes\n");
        assert_eq!(memory_with(&[("/proc/meminfo", MEMINFO), limits]), Some(4 << 30));
    }

    #[test]
    fn this_machine_has_some_memory() {
        assert!(default_limit() >= 16 << 20);
    }
}
