/* Loaded before the C library, gives a program a camera /dev/video42 that another program streams from.
 *
 * It answers as Linux' drivers do (kernel documentation, "Multiple Opens"): anyone may open the device and ask what it can,
 * but who sets a format or asks for buffers gets EBUSY, which is also said on standard error, so that a test knows.
 * Everything else goes on to the C library.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static const char *const DEVICE = "/dev/video42";
static int device = -1;

static int real_open(const char *symbol, const char *path, int flags, mode_t mode)
{
    int (*next)(const char *, int, ...) = dlsym(RTLD_NEXT, symbol);
    if (strcmp(path, DEVICE) == 0)
        return device = next("/dev/null", O_RDWR);
    return next(path, flags, mode);
}

#define OPENER(name)                                                                                                   \
    int name(const char *path, int flags, ...)                                                                         \
    {                                                                                                                  \
        va_list rest;                                                                                                  \
        va_start(rest, flags);                                                                                         \
        mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0;                                        \
        va_end(rest);                                                                                                  \
        return real_open(#name, path, flags, mode);                                                                    \
    }
OPENER(open)
OPENER(open64)

int ioctl(int file, unsigned long request, ...)
{
    va_list rest;
    va_start(rest, request);
    void *argument = va_arg(rest, void *);
    va_end(rest);
    if (file != device || device < 0) {
        int (*next)(int, unsigned long, ...) = dlsym(RTLD_NEXT, "ioctl");
        return next(file, request, argument);
    }
    switch (request) {
    case VIDIOC_QUERYCAP: {
        struct v4l2_capability *capability = argument;
        memset(capability, 0, sizeof *capability);
        strcpy((char *)capability->driver, "uvcvideo");
        strcpy((char *)capability->card, "Mouth Tracker");
        capability->capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING | V4L2_CAP_DEVICE_CAPS;
        capability->device_caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
        return 0;
    }
    case VIDIOC_G_INPUT:
        *(int *)argument = 0;
        return 0;
    case VIDIOC_S_INPUT:
    case VIDIOC_TRY_FMT:
    case VIDIOC_G_FMT:
        return 0;
    case VIDIOC_S_FMT:
    case VIDIOC_REQBUFS:
    case VIDIOC_STREAMON:
        dprintf(2, "the camera says EBUSY\n");
        errno = EBUSY;
        return -1;
    default:
        errno = ENOTTY;
        return -1;
    }
}
