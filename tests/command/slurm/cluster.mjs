/**
 * A small real Slurm cluster for tests, on the loopback address and within one folder: its own
 * munged, slurmctld and slurmd nodes. It needs root and Debian's packages slurmctld and slurmd.
 */
import { execFile, spawn } from 'node:child_process';
import { randomBytes, randomInt } from 'node:crypto';
import { lookup } from 'node:dns/promises';
import fs from 'node:fs';
import net from 'node:net';
import os from 'node:os';
import path from 'node:path';
import { setTimeout as sleep } from 'node:timers/promises';

const address = '127.0.0.1';
const unfinished = new RegExp('PENDING|RUNNING|COMPLETING|CONFIGURING|REQUEUE|SUSPENDED|STOPPED|'
  + 'SIGNALING|RESIZING|STAGE_OUT');

/**
 * Starts a cluster whose files all lie in the folder, which must exist and is the caller's to
 * remove. Throws, with nothing left running, when a daemon does not come up.
 */
export async function startCluster(folder, { nodes = 2, cpus = 2, memory = 65536 } = {}) {
  const home = fs.realpathSync(folder);
  const config = path.join(home, 'slurm.conf');
  const socket = path.join(home, 'munge', 'socket');
  const names = Array.from({ length: nodes }, (_, index) => `node${index}`);
  const env = makeEnvironment(config);
  const stopping = new AbortController();
  const wrapper = await makeWrapper();
  const killTimes = new Map();

  if (process.getuid() !== 0) throw new Error('The test cluster must be started by root.');
  if (home.length > 70) throw new Error(`The path is too long for Unix sockets: ${home}`);
  const [port, ...nodePorts] = await chooseFreePorts(1 + nodes);
  fs.mkdirSync(path.join(home, 'munge'), { mode: 0o700 });
  fs.writeFileSync(path.join(home, 'munge', 'key'), randomBytes(128), { mode: 0o600 });
  for (const name of ['state', ...names]) fs.mkdirSync(path.join(home, name));
  fs.writeFileSync(path.join(home, 'plugstack.conf'), '');
  fs.writeFileSync(config, writeConfig({ home, socket, port, nodePorts, names, cpus, memory }));

  /** Runs one of Slurm's commands and tells how it ended; a code other than 0 is no error. */
  function run(program, ...args) {
    return new Promise((resolve, reject) => {
      const options = { cwd: home, env, timeout: 60_000, signal: stopping.signal };
      execFile(program, args, options, (error, stdout, stderr) => {
        if (error && typeof error.code !== 'number') reject(error);
        else resolve({ stdout, stderr, code: error ? error.code : 0 });
      });
    });
  }

  /** Starts a daemon in the foreground and waits until the check says that it is up. */
  async function startDaemon(name, isUp, program, ...args) {
    stopping.signal.throwIfAborted();
    const output = fs.openSync(path.join(home, `${name}.err`), 'a');
    const daemonEnv = { ...env, SLURMD_NODENAME: name };
    const stdio = ['ignore', output, output];
    const [file, ...rest] = [...wrapper, program, ...args];
    const child = spawn(file, rest, { cwd: home, env: daemonEnv, stdio });
    let end;
    child.once('error', (error) => (end = `could not be started (${error.message})`));
    child.once('exit', (code, signal) => (end ??= `ended early (${signal ?? code})`));
    fs.closeSync(output);
    try {
      await waitUntil(20, `${name} did not come up.`, async () => {
        if (end) throw new Error(`${name} ${end}.`);
        return isUp();
      });
    } catch (error) {
      throw new Error(`${error.message}\n${readLogTail(home, name)}`);
    }
  }

  /** Starts the slurmd of a node (again) and waits until it can take jobs. */
  async function startNode(name) {
    // When a node registers, slurmctld misses (and requeues) only jobs older than 3 s.
    const pause = (killTimes.get(name) ?? 0) + 4000 - Date.now();
    await sleep(Math.max(0, pause), undefined, { signal: stopping.signal });
    const started = Math.floor(Date.now() / 1000) * 1000;
    const isUp = async () => {
      const [node] = readRecords((await run('scontrol', '-o', 'show', 'node', name)).stdout);
      const usable = /^(IDLE|MIXED|ALLOCATED)(\+COMPLETING)?$/.test(node?.State);
      return usable && Date.parse(node.SlurmdStartTime) >= started;
    };
    await startDaemon(name, isUp, 'slurmd', '-D', '-N', name, '-f', config);
  }

  /** Ends a node as a power cut would: slurmd, its steps and all that they started. */
  async function killNode(name) {
    await killProcesses(() => findProcesses(home, config, [name]));
    killTimes.set(name, Date.now());
  }

  /** Waits until all these jobs (or job arrays) have ended, and returns how each task ended. */
  async function waitForJobs(ids, timeoutSeconds) {
    let jobs = [];
    const haveEnded = async () => {
      const show = (id) => run('scontrol', '-o', 'show', 'job', id);
      const shown = await Promise.all(ids.map(show));
      const failed = shown.find(({ code }) => code !== 0);
      if (failed) throw new Error(`scontrol show job: ${failed.stderr.trim()}`);
      jobs = shown.flatMap(({ stdout }) => readRecords(stdout)).map(describeJob);
      return !jobs.some(({ state }) => unfinished.test(state));
    };
    try {
      await waitUntil(timeoutSeconds, 'The jobs have not ended.', haveEnded, 250);
    } catch (error) {
      throw new Error(`${error.message}\n${JSON.stringify(jobs, null, 1)}\n${log()}`);
    }
    return jobs;
  }

  /** The last lines of each daemon's log, for messages about failures. */
  function log() {
    return ['munged', 'slurmctld', ...names].map((name) => readLogTail(home, name)).join('\n');
  }

  const findAll = () => findProcesses(home, config, ['munged', 'slurmctld', ...names]);
  const killAtExit = () => {
    stopping.abort();
    for (let round = 0; round < 5; round++) findAll().forEach(kill);
  };
  const exitBySignal = (signal) => process.exit(128 + os.constants.signals[signal]);
  const signals = ['SIGINT', 'SIGTERM', 'SIGHUP'];
  process.on('exit', killAtExit);
  signals.forEach((signal) => process.on(signal, exitBySignal));

  /** Ends all daemons and jobs, and returns when none of their processes is left. */
  async function stop() {
    stopping.abort();
    await killProcesses(findAll);
    process.off('exit', killAtExit);
    signals.forEach((signal) => process.off(signal, exitBySignal));
  }

  try {
    const hasMunge = async () =>
      (await run('munge', '--no-input', `--socket=${socket}`)).code === 0;
    const files = ['key', 'log', 'pid', 'seed'];
    await startDaemon('munged', hasMunge, 'munged', '--foreground', '--force',
      `--socket=${socket}`,
      ...files.map((file) => `--${file}-file=${path.join(home, 'munge', file)}`));
    const hasController = async () => (await run('scontrol', 'ping')).code === 0;
    await startDaemon('slurmctld', hasController, 'slurmctld', '-D', '-f', config);
    await Promise.all(names.map(startNode));
  } catch (error) {
    await stop();
    throw error;
  }
  return { env, run, waitForJobs, killNode, startNode, log, stop };
}

/** The environment for Slurm's commands, free of what an outer Slurm job may have set. */
function makeEnvironment(config) {
  const slurms = /^(SLURM|SBATCH|SRUN|SALLOC|SQUEUE|SINFO|SCANCEL|SCONTROL)/;
  const outer = Object.entries(process.env).filter(([name]) => !slurms.test(name));
  const programs = `${process.env.PATH ?? '/usr/bin:/bin'}:/usr/sbin:/sbin`;
  return { ...Object.fromEntries(outer), PATH: programs, SLURM_CONF: config };
}

/**
 * What to put before a daemon's command. Slurm's daemons listen where the host's name leads to;
 * when that is not the loopback address, they are given another host name of their own.
 */
async function makeWrapper() {
  const found = await lookup(os.hostname(), { family: 4 }).catch(() => undefined);
  if (found?.address === address) return [];
  return ['unshare', '--uts', 'sh', '-c', 'hostname localhost && exec "$@"', 'sh'];
}

/** Finds free ports below those that the system gives to outgoing connections. */
async function chooseFreePorts(count) {
  const servers = [];
  for (let tries = 0; servers.length < count && tries < 500; tries++) {
    const server = net.createServer();
    const listens = await new Promise((resolve) => {
      server.once('error', () => resolve(false));
      server.listen(randomInt(20000, 32000), address, () => resolve(true));
    });
    if (listens) servers.push(server);
  }
  const ports = servers.map((server) => server.address().port);
  await Promise.all(servers.map((server) => new Promise((resolve) => server.close(resolve))));
  if (ports.length < count) throw new Error('No free ports were found.');
  return ports;
}

/** The text of slurm.conf; what it leaves out (accounting, task plugins) is none by default. */
function writeConfig({ home, socket, port, nodePorts, names, cpus, memory }) {
  return [
    'ClusterName=trial',
    `SlurmctldHost=localhost(${address})`,
    `SlurmctldPort=${port}`,
    'CommunicationParameters=NoInAddrAny,NoCtldInAddrAny',
    'SlurmUser=root',
    'SlurmdUser=root',
    'AuthType=auth/munge',
    'CredType=cred/munge',
    `AuthInfo=socket=${socket},cred_expire=5`,
    `StateSaveLocation=${home}/state`,
    `SlurmctldPidFile=${home}/slurmctld.pid`,
    `SlurmdSpoolDir=${home}/%n`,
    `SlurmdPidFile=${home}/%n.pid`,
    `SlurmdLogFile=${home}/%n.log`,
    `PlugStackConfig=${home}/plugstack.conf`,
    'MailProg=/bin/true',
    'ProctrackType=proctrack/linuxproc',
    'SelectType=select/cons_tres',
    'SelectTypeParameters=CR_CPU',
    'SchedulerType=sched/backfill',
    'SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0',
    'SlurmdParameters=config_overrides',
    'JobRequeue=1',
    'ReturnToService=2',
    'SlurmdTimeout=5',
    'BatchStartTimeout=1',
    'MessageTimeout=2',
    'TCPTimeout=1',
    'KillWait=1',
    'MinJobAge=3600',
    ...names.map((name, index) => `NodeName=${name} NodeHostname=localhost `
      + `NodeAddr=${address} Port=${nodePorts[index]} CPUs=${cpus} RealMemory=${memory}`),
    `PartitionName=main Nodes=${names.join(',')} Default=YES MaxTime=INFINITE State=UP`,
    ''
  ].join('\n');
}

/** Reads scontrol's one-line records into objects. */
function readRecords(text) {
  return text.split('\n').filter(Boolean).map((line) => {
    const fields = [...line.matchAll(/(\S+?)=(\S*)/g)];
    return Object.fromEntries(fields.map(([, key, value]) => [key, value]));
  });
}

/** What tests want to know of a job or array task as scontrol shows it. */
function describeJob(record) {
  const isTask = record.ArrayTaskId !== undefined;
  return {
    id: isTask ? `${record.ArrayJobId}_${record.ArrayTaskId}` : record.JobId,
    state: record.JobState,
    reason: record.Reason,
    exitCode: record.ExitCode,
    node: record.NodeList,
    restarts: Number(record.Restarts),
    start: record.StartTime,
    end: record.EndTime
  };
}

/** The last lines of a daemon's log, or of its output when it has no log yet. */
function readLogTail(home, name) {
  const file = path.join(home, name);
  const text = readText(`${file}.log`) || readText(`${file}.err`);
  return `--- ${name}\n${text.trimEnd().split("\n').slice(-15).join('\n")}`;
}

/**
 * The running processes of these daemons: those that hold the daemon's log (a slurmstepd wipes
 * its environment), the jobs, known by their environment, and all that descend from either.
 */
function findProcesses(home, config, names) {
  const logs = new Set(names.flatMap((name) => [`${home}/${name}.log`, `${home}/${name}.err`]));
  const children = new Map();
  const daemons = [];
  const jobs = [];
  for (const pid of fs.readdirSync('/proc').filter((name) => /^\d+$/.test(name)).map(Number)) {
    const stat = readText(`/proc/${pid}/stat`);
    const [state, parent] = stat.slice(stat.lastIndexOf(')') + 2).split(' ');
    if (!state || state === 'Z' || state === 'X' || pid === process.pid) continue;
    children.set(Number(parent), [...(children.get(Number(parent)) ?? []), pid]);
    const program = path.basename(readLink(`/proc/${pid}/exe`));
    const environment = readText(`/proc/${pid}/environ`).split('\0');
    const isOurs = environment.includes(`SLURM_CONF=${config}`)
      && names.some((name) => environment.includes(`SLURMD_NODENAME=${name}`));
    if (/^(slurm|munged)/.test(program) && holdsAny(pid, logs)) daemons.push(pid);
    else if (isOurs) jobs.push(pid);
  }
  // Daemons come first, so that no slurmstepd lives to report the end of its killed job.
  const found = new Set([...daemons, ...jobs]);
  for (const pid of found) children.get(pid)?.forEach((child) => found.add(child));
  return [...found];
}

/** Whether the process has one of the files open. */
function holdsAny(pid, files) {
  try {
    const open = fs.readdirSync(`/proc/${pid}/fd`);
    return open.some((number) => files.has(readLink(`/proc/${pid}/fd/${number}`)));
  } catch {
    return false;
  }
}

/** A file's text, or nothing when it is gone (as processes come and go). */
function readText(file) {
  try {
    return fs.readFileSync(file, 'utf8');
  } catch {
    return '';
  }
}

/** Where a link leads, or nothing when it is gone. */
function readLink(file) {
  try {
    return fs.readlinkSync(file);
  } catch {
    return '';
  }
}

/** Kills a process that may have ended by itself. */
function kill(pid) {
  try {
    process.kill(pid, 'SIGKILL');
  } catch (error) {
    if (error.code !== 'ESRCH') throw error;
  }
}

/** Kills what the search finds until it finds nothing more. */
async function killProcesses(find) {
  await waitUntil(10, 'Some processes do not end.', () => {
    const pids = find();
    pids.forEach(kill);
    return pids.length === 0;
  });
}

/** Asks again and again until the check is true; throws the message when the time is over. */
async function waitUntil(seconds, message, check, pauseMs = 50) {
  const end = Date.now() + seconds * 1000;
  while (!(await check())) {
    if (Date.now() > end) throw new Error(`${message} (${seconds} s)`);
    await sleep(pauseMs);
  }
}
