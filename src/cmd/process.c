// Running a renderer as a process of its own, with a time limit.
#include "cmd/cmd.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

// In the new process: only calls that are safe between fork and exec.
static void start(const struct process *p)
{
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL); // it ends with who waits for it, interrupted or not
#endif
    int in = open("/dev/null", O_RDONLY);
    int out = open(p->log ? p->log : "/dev/null", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (in < 0 || out < 0 || (p->folder && chdir(p->folder) != 0))
        _exit(126);
    dup2(in, STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
    execvp(p->argv[0], (char *const *)(const void *)p->argv);
    static const char why[] = "error: there is no such program\n";
    if (write(STDERR_FILENO, why, sizeof why - 1) < 0)
        _exit(126);
    _exit(127);
}

// The other end of the pipe closes when the process ends: no need to look again and
// again whether it has.
static bool wait_closed(int fd, double limit)
{
    struct pollfd poll_fd = {.fd = fd, .events = POLLIN};
    double end = cmd_seconds() + limit;
    for (;;) {
        double left = end - cmd_seconds();
        int n = left > 0 ? poll(&poll_fd, 1, (int)(left * 1000) + 1) : 0;
        if (n > 0)
            return true;
        if (n == 0 && left <= 0)
            return false;
        if (n < 0 && errno != EINTR)
            return true;
    }
}

double process_run(struct process *p)
{
    int ends[2];
    p->status = -1;
    if (pipe(ends) != 0)
        return 0;
    double begin = cmd_seconds();
    pid_t pid = fork();
    if (pid == 0) {
        close(ends[0]);
        start(p);
    }
    close(ends[1]);
    bool in_time = pid > 0 && wait_closed(ends[0], p->limit);
    if (pid > 0 && !in_time)
        kill(pid, SIGKILL);
    while (pid > 0 && waitpid(pid, &p->status, 0) < 0 && errno == EINTR)
        ;
    close(ends[0]);
    double seconds = cmd_seconds() - begin;
    return in_time ? seconds : -seconds;
}
