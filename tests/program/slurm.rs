//! Shards as a Slurm job array, by the two scripts of `spec/examples`: a cluster of this one
//! machine is started for it. `cargo test --test program -- --ignored slurm::` as root (Debian
//! packages `slurm-wlm` and `munge`); two minutes.
#![cfg(all(unix, feature = "cli"))]

use crate::program::mceip;
use mceip_model::{Body, Problem, Unknown};
use mceip_testkit::{known, mechanical_pencil};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

/// munged, slurmctld and slurmd with all their files in one folder; ended by their process ids.
struct Cluster {
    folder: tempfile::TempDir,
}

impl Cluster {
    fn start() -> Cluster {
        let cluster = Cluster {
            folder: tempfile::tempdir().unwrap(),
        };
        let at = |name: &str| cluster.path(name).display().to_string();
        for name in ["state", "spool"] {
            std::fs::create_dir(cluster.path(name)).unwrap();
        }
        let host = run(&mut Command::new("hostname"), &["-s"]);
        let cpus = std::thread::available_parallelism().unwrap();
        let ports: Vec<u16> = (0..2)
            .map(|_| std::net::TcpListener::bind("127.0.0.1:0").unwrap())
            .collect::<Vec<_>>()
            .iter()
            .map(|l| l.local_addr().unwrap().port())
            .collect();
        let lines = [
            format!("ClusterName=one\nSlurmctldHost={host}(127.0.0.1)\nSlurmUser=root\nSlurmdUser=root"),
            format!("AuthType=auth/munge\nCredType=cred/munge\nAuthInfo=socket={}", at("munge.socket")),
            format!("StateSaveLocation={}\nSlurmdSpoolDir={}", at("state"), at("spool")),
            format!("SlurmctldPidFile={}\nSlurmdPidFile={}", at("slurmctld.pid"), at("slurmd.pid")),
            format!("SlurmctldLogFile={}\nSlurmdLogFile={}", at("slurmctld.log"), at("slurmd.log")),
            format!("SlurmctldPort={}\nSlurmdPort={}", ports[0], ports[1]),
            "ProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\nJobAcctGatherType=jobacct_gather/none".into(),
            "SelectType=select/cons_tres\nSelectTypeParameters=CR_CPU\nReturnToService=2\nMpiDefault=none\nSwitchType=switch/none".into(),
            format!("NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN"),
            format!("PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP\n"),
        ];
        std::fs::write(cluster.path("slurm.conf"), lines.join("\n")).unwrap();
        let mut key = [0u8; 64];
        std::io::Read::read_exact(&mut std::fs::File::open("/dev/urandom").unwrap(), &mut key)
            .unwrap();
        std::fs::write(cluster.path("munge.key"), key).unwrap();
        std::fs::set_permissions(
            cluster.path("munge.key"),
            std::os::unix::fs::PermissionsExt::from_mode(0o600),
        )
        .unwrap();
        let files = [
            ("key-file", "munge.key"),
            ("socket", "munge.socket"),
            ("pid-file", "munged.pid"),
            ("log-file", "munged.log"),
        ];
        let mut munge: Vec<String> = files
            .iter()
            .map(|(option, name)| format!("--{option}={}", at(name)))
            .collect();
        munge.extend([
            format!("--seed-file={}", at("munged.seed")),
            "--force".into(),
        ]);
        run(
            &mut Command::new("munged"),
            &munge.iter().map(String::as_str).collect::<Vec<_>>(),
        );
        for daemon in ["slurmctld", "slurmd"] {
            cluster.slurm(daemon, &["-f", &at("slurm.conf")]);
        }
        cluster.until("the node is idle", || {
            cluster.slurm("sinfo", &["-h", "-o", "%T"]) == "idle"
        });
        cluster
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        let bin = Path::new(env!("CARGO_BIN_EXE_mceip")).parent().unwrap();
        let path = format!(
            "{}:{}",
            bin.display(),
            std::env::var("PATH").unwrap_or_default()
        );
        command
            .env("SLURM_CONF", self.path("slurm.conf"))
            .env("PATH", path);
        command
    }

    fn slurm(&self, program: &str, args: &[&str]) -> String {
        run(&mut self.command(program), args)
    }

    /// Submits a script of `spec/examples` in a folder of the cluster; the job's number.
    fn submit(&self, job: &str, script: &str, restarts: u32, options: &[&str]) -> String {
        let script = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("spec/examples")
            .join(script)
            .display()
            .to_string();
        let mut command = self.command("sbatch");
        command
            .env("MCEIP_RESTARTS", restarts.to_string())
            .current_dir(self.path(job));
        run(
            &mut command,
            &[&["--parsable"], options, &[&script]].concat(),
        )
    }

    /// A field of `scontrol show job`, the same for all tasks of an array.
    fn field(&self, job: &str, name: &str) -> Vec<String> {
        let shown = self.slurm("scontrol", &["show", "job", job]);
        let mut all: Vec<String> = shown
            .split_whitespace()
            .filter_map(|w| w.strip_prefix(&format!("{name}=")))
            .map(String::from)
            .collect();
        all.sort();
        all.dedup();
        all
    }

    #[track_caller]
    fn until(&self, what: &str, mut holds: impl FnMut() -> bool) {
        let start = Instant::now();
        while !holds() {
            assert!(
                start.elapsed() < Duration::from_secs(150),
                "{what}: not within 150 s\n{}",
                self.slurm("squeue", &["-a"])
            );
            std::thread::sleep(Duration::from_millis(300));
        }
    }

    /// A folder with problem.json.
    fn job(&self, name: &str, problem: &Problem) {
        let Body::Pencil(pencil) = problem.body() else {
            panic!("a pencil")
        };
        let dense = |m: &mceip_exact::Sparse| -> Vec<Vec<String>> {
            (0..m.rows())
                .map(|i| (0..m.cols()).map(|j| m.get(i, j).to_string()).collect())
                .collect()
        };
        let pencil =
            serde_json::json!({ "a": dense(pencil.a()), "b": dense(pencil.b()), "free": [] });
        let file = serde_json::json!({ "format": "mceip-problem/1", "unknown": problem.unknown().word(), "pencil": pencil });
        std::fs::create_dir(self.path(name)).unwrap();
        std::fs::write(self.path(name).join("problem.json"), file.to_string()).unwrap();
    }

    fn check(&self, job: &str, certificate: &str) -> Option<i32> {
        let at = |name: &str| self.path(job).join(name).display().to_string();
        mceip(&["check", &at("problem.json"), &at(certificate)])
            .status
            .code()
    }
}

impl Drop for Cluster {
    fn drop(&mut self) {
        drop(self.command("scancel").args(["--user", "root"]).status());
        std::thread::sleep(Duration::from_secs(1));
        for name in ["slurmd.pid", "slurmctld.pid", "munged.pid"] {
            if let Ok(pid) = std::fs::read_to_string(self.path(name)) {
                drop(Command::new("kill").arg(pid.trim()).status());
            }
        }
    }
}

#[track_caller]
fn run(command: &mut Command, args: &[&str]) -> String {
    let o = command
        .args(args)
        .output()
        .unwrap_or_else(|e| panic!("{command:?}: {e}; apt-get install slurm-wlm munge"));
    assert!(
        o.status.success(),
        "{command:?}: {}{}",
        String::from_utf8_lossy(&o.stdout),
        String::from_utf8_lossy(&o.stderr)
    );
    String::from_utf8_lossy(&o.stdout).trim().to_string()
}

#[test]
#[ignore = "needs Slurm and munge, root, two minutes"]
fn a_job_array_is_merged_and_an_interrupted_part_is_never_taken_for_a_whole() {
    let cluster = Cluster::start();
    let after = |kind: &str, job: &str| format!("--dependency={kind}:{job}");

    // All parts end well: exit 3 of a part is no failure, the merge runs after them and proves the
    // whole.
    cluster.job("graph", &known::complete_graph(9).unwrap().problem);
    let parts = cluster.submit("graph", "slurm-array.sh", 0, &[]);
    let merge = cluster.submit("graph", "slurm-merge.sh", 0, &[&after("afterok", &parts)]);
    cluster.until("the merge ends", || {
        cluster.field(&merge, "JobState") == ["COMPLETED"]
    });
    assert_eq!(cluster.field(&parts, "ExitCode"), ["0:0"]);
    assert_eq!(cluster.check("graph", "whole.json"), Some(0));

    // SIGINT before the time is up, no restart left: the task fails with 130, what it proved is
    // there, the merge after any end says undecided (or names the piece that nobody searched), and
    // the merge after a good end never runs.
    cluster.job("long", &mechanical_pencil(44, Unknown::Mu, 3).unwrap());
    let short = ["--array=1-1", "--time=1", "--signal=INT@52"];
    let part = cluster.submit("long", "slurm-array.sh", 1, &short);
    let ok = cluster.submit("long", "slurm-merge.sh", 0, &[&after("afterok", &part)]);
    let any = cluster.submit("long", "slurm-merge.sh", 0, &[&after("afterany", &part)]);
    cluster.until("the part is queued again", || {
        cluster.field(&part, "Restarts") == ["1"] && cluster.field(&part, "JobState") == ["PENDING"]
    });
    assert_eq!(cluster.check("long", "part-1.json"), Some(3));
    let first = std::fs::metadata(cluster.path("long/part-1.json"))
        .unwrap()
        .len();
    assert_eq!(
        (
            cluster.field(&ok, "JobState"),
            cluster.field(&any, "JobState")
        ),
        (vec!["PENDING".into()], vec!["PENDING".into()])
    );
    // Slurm waits two minutes before it starts a task again; not so here.
    cluster.slurm(
        "scontrol",
        &["update", &format!("JobId={part}_1"), "StartTime=now"],
    );
    cluster.until("the part fails", || {
        cluster.field(&part, "JobState") == ["FAILED"]
    });
    assert_eq!(cluster.field(&part, "ExitCode"), ["130:0"]);
    assert_eq!(cluster.check("long", "part-1.json"), Some(3));
    let second = std::fs::metadata(cluster.path("long/part-1.json"))
        .unwrap()
        .len();
    assert!(
        second > first,
        "it went on with its own part: {first} then {second} bytes"
    );
    cluster.until("the merge after any end", || {
        cluster.field(&any, "JobState") == ["FAILED"]
    });
    let code = cluster.field(&any, "ExitCode");
    assert!(code == ["3:0"] || code == ["2:0"], "{code:?}");
    cluster.until("the other is never run", || {
        cluster.field(&ok, "Reason") == ["DependencyNeverSatisfied"]
    });
}
