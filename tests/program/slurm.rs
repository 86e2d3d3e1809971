//! Shards as a Slurm job array, by the two scripts of `spec/examples`: a cluster of this one
//! machine is started for it. `cargo test --test program -- --ignored slurm::` as root (Debian
//! packages `slurm-wlm` and `munge`); two minutes.
//!
//! `mceip check` judges the certificates. A part that was interrupted must not be taken for a
//! whole: the states and exit codes of Slurm, and the size of the part, show what became of it.
#![cfg(all(unix, feature = "cli"))]

use crate::common::{exit_code, problem_text, repository};
use mceip_model::{Problem, Unknown};
use mceip_testkit::{known, mechanical_pencil};
use std::fs::{File, Permissions};
use std::io::Read as _;
use std::net::TcpListener;
use std::os::unix::fs::PermissionsExt as _;
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
        for name in ["state", "spool"] {
            std::fs::create_dir(cluster.path(name)).unwrap();
        }

        std::fs::write(cluster.path("slurm.conf"), cluster.configuration()).unwrap();

        cluster.start_munge();
        for daemon in ["slurmctld", "slurmd"] {
            cluster.slurm(daemon, &["-f", &cluster.file("slurm.conf")]);
        }

        cluster.until("the node is idle", || {
            cluster.slurm("sinfo", &["-h", "-o", "%T"]) == "idle"
        });
        cluster
    }

    /// The text of slurm.conf: this machine is the only node.
    fn configuration(&self) -> String {
        let host = run(&mut Command::new("hostname"), &["-s"]);
        let cpus = std::thread::available_parallelism().unwrap();
        let [controller_port, node_port] = two_free_ports();

        let lines = [
            "ClusterName=one".to_string(),
            format!("SlurmctldHost={host}(127.0.0.1)"),
            "SlurmUser=root".to_string(),
            "SlurmdUser=root".to_string(),
            "AuthType=auth/munge".to_string(),
            "CredType=cred/munge".to_string(),
            format!("AuthInfo=socket={}", self.file("munge.socket")),
            format!("StateSaveLocation={}", self.file("state")),
            format!("SlurmdSpoolDir={}", self.file("spool")),
            format!("SlurmctldPidFile={}", self.file("slurmctld.pid")),
            format!("SlurmdPidFile={}", self.file("slurmd.pid")),
            format!("SlurmctldLogFile={}", self.file("slurmctld.log")),
            format!("SlurmdLogFile={}", self.file("slurmd.log")),
            format!("SlurmctldPort={controller_port}"),
            format!("SlurmdPort={node_port}"),
            "ProctrackType=proctrack/linuxproc".to_string(),
            "TaskPlugin=task/none".to_string(),
            "JobAcctGatherType=jobacct_gather/none".to_string(),
            "SelectType=select/cons_tres".to_string(),
            "SelectTypeParameters=CR_CPU".to_string(),
            "ReturnToService=2".to_string(),
            "MpiDefault=none".to_string(),
            "SwitchType=switch/none".to_string(),
            format!("NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN"),
            format!("PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP"),
        ];

        lines.join("\n") + "\n"
    }

    /// Starts munged with a new random key.
    fn start_munge(&self) {
        let mut key = [0u8; 64];
        let mut source = File::open("/dev/urandom").unwrap();
        source.read_exact(&mut key).unwrap();
        std::fs::write(self.path("munge.key"), key).unwrap();
        std::fs::set_permissions(self.path("munge.key"), Permissions::from_mode(0o600)).unwrap();

        let mut munged = Command::new("munged");
        for (option, name) in [
            ("key-file", "munge.key"),
            ("socket", "munge.socket"),
            ("pid-file", "munged.pid"),
            ("log-file", "munged.log"),
            ("seed-file", "munged.seed"),
        ] {
            munged.arg(format!("--{option}={}", self.file(name)));
        }

        run(&mut munged, &["--force"]);
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The same as text.
    fn file(&self, name: &str) -> String {
        self.path(name).display().to_string()
    }

    /// How many bytes a file has.
    fn length(&self, name: &str) -> u64 {
        std::fs::metadata(self.path(name)).unwrap().len()
    }

    /// A program that sees this cluster and finds `mceip`.
    fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        let bin = Path::new(env!("CARGO_BIN_EXE_mceip")).parent().unwrap();
        let old_path = std::env::var("PATH").unwrap_or_default();
        let path = format!("{}:{old_path}", bin.display());
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
        let script = repository(&format!("spec/examples/{script}"));
        let mut sbatch = self.command("sbatch");
        sbatch
            .env("MCEIP_RESTARTS", restarts.to_string())
            .current_dir(self.path(job));

        run(
            &mut sbatch,
            &[&["--parsable"], options, &[&script]].concat(),
        )
    }

    /// A field of `scontrol show job`, the same for all tasks of an array.
    fn field(&self, job: &str, name: &str) -> Vec<String> {
        let shown = self.slurm("scontrol", &["show", "job", job]);
        let key = format!("{name}=");
        let values = shown
            .split_whitespace()
            .filter_map(|word| word.strip_prefix(&key));

        let mut all: Vec<String> = values.map(String::from).collect();
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
        let folder = self.path(name);
        std::fs::create_dir(&folder).unwrap();
        std::fs::write(folder.join("problem.json"), problem_text(problem)).unwrap();
    }

    fn check(&self, job: &str, certificate: &str) -> Option<i32> {
        let problem = self.file(&format!("{job}/problem.json"));
        let certificate = self.file(&format!("{job}/{certificate}"));
        exit_code(&format!("check {problem} {certificate}"))
    }
}

/// Two ports that nobody listens on. Both are taken before either is given back.
fn two_free_ports() -> [u16; 2] {
    let listeners = [(); 2].map(|()| TcpListener::bind("127.0.0.1:0").unwrap());
    listeners.map(|listener| listener.local_addr().unwrap().port())
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
    let output = command
        .args(args)
        .output()
        .unwrap_or_else(|error| panic!("{command:?}: {error}; apt-get install slurm-wlm munge"));
    let text = String::from_utf8_lossy(&output.stdout);
    let message = String::from_utf8_lossy(&output.stderr);

    assert!(output.status.success(), "{command:?}: {text}{message}");
    text.trim().to_string()
}

/// The option of `sbatch` that makes a job wait for another one.
fn after(kind: &str, job: &str) -> String {
    format!("--dependency={kind}:{job}")
}

#[test]
#[ignore = "needs Slurm and munge, root, two minutes"]
fn a_job_array_is_merged_and_an_interrupted_part_is_never_taken_for_a_whole() {
    let cluster = Cluster::start();

    a_job_array_is_merged(&cluster);
    an_interrupted_part_is_not_taken_for_a_whole(&cluster);
}

/// All parts end well: exit 3 of a part is no failure, the merge runs after them and proves the
/// whole.
fn a_job_array_is_merged(cluster: &Cluster) {
    cluster.job("graph", &known::complete_graph(9).unwrap().problem);
    let parts = cluster.submit("graph", "slurm-array.sh", 0, &[]);
    let merge = cluster.submit("graph", "slurm-merge.sh", 0, &[&after("afterok", &parts)]);
    cluster.until("the merge ends", || {
        cluster.field(&merge, "JobState") == ["COMPLETED"]
    });

    assert_eq!(cluster.field(&parts, "ExitCode"), ["0:0"]);
    assert_eq!(cluster.check("graph", "whole.json"), Some(0));
}

/// SIGINT before the time is up, no restart left: the task fails with 130, what it proved is
/// there, the merge after any end says undecided (or names the piece that nobody searched), and
/// the merge after a good end never runs.
fn an_interrupted_part_is_not_taken_for_a_whole(cluster: &Cluster) {
    cluster.job("long", &mechanical_pencil(44, Unknown::Mu, 3).unwrap());
    let short = ["--array=1-1", "--time=1", "--signal=INT@52"];
    let part = cluster.submit("long", "slurm-array.sh", 1, &short);
    let ok = cluster.submit("long", "slurm-merge.sh", 0, &[&after("afterok", &part)]);
    let any = cluster.submit("long", "slurm-merge.sh", 0, &[&after("afterany", &part)]);

    cluster.until("the part is queued again", || {
        cluster.field(&part, "Restarts") == ["1"] && cluster.field(&part, "JobState") == ["PENDING"]
    });

    assert_eq!(cluster.check("long", "part-1.json"), Some(3));

    let first = cluster.length("long/part-1.json");
    assert_eq!(cluster.field(&ok, "JobState"), ["PENDING"]);
    assert_eq!(cluster.field(&any, "JobState"), ["PENDING"]);

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

    let second = cluster.length("long/part-1.json");
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
